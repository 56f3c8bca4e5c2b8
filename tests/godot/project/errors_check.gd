# What cannot be is refused with a message that says what, and nothing else happens. The messages are read by the test.
extends "res://checks.gd"


func check() -> void:
	_refuses_worlds()
	_refuses_calls()


func _refused(what: String, world: BrittleWorld3D) -> void:
	holds(what + " is refused", not world.start() and not world.is_started())
	world.free()


func _refuses_worlds() -> void:
	_refused("a world without bodies", new_world())
	var open_world := new_world()
	new_body(open_world, QuadMesh.new(), Vector3.UP).name = "Sheet"
	_refused("an open mesh", open_world)
	var no_mesh := new_world()
	new_body(no_mesh, null, Vector3.UP)
	_refused("a body without a mesh", no_mesh)
	var lines := ArrayMesh.new()
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array([Vector3.ZERO, Vector3.UP])
	lines.add_surface_from_arrays(Mesh.PRIMITIVE_LINES, arrays)
	var no_triangles := new_world()
	new_body(no_triangles, lines, Vector3.UP)
	_refused("a mesh of lines", no_triangles)
	var flat := new_world()
	new_body(flat, BoxMesh.new(), Vector3.UP).scale = Vector3(1, 0, 1)
	_refused("a flattened body", flat)
	var moving_plane := new_world()
	new_body(moving_plane, PlaneMesh.new(), Vector3.UP).shape = BrittleBody3D.SHAPE_PLANE
	_refused("a plane that moves", moving_plane)
	var heavy := new_world()
	new_body(heavy, BoxMesh.new(), Vector3.UP).density = -1
	_refused("a density below nothing", heavy)
	var unknown := new_world()
	new_body(unknown, BoxMesh.new(), Vector3.UP, "glas")
	_refused("a material that there is none of", unknown)
	var slow := new_world()
	new_body(slow, BoxMesh.new(), Vector3.UP)
	slow.step_seconds = 0
	_refused("steps of no length", slow)
	var placeless := new_world()
	var body := new_body(placeless, null, Vector3.UP)
	body.copies = MultiMesh.new()
	body.copies.mesh = BoxMesh.new()
	_refused("a MultiMesh without instances", placeless)


func _refuses_calls() -> void:
	var world := new_world()
	var body := new_body(world, BoxMesh.new(), Vector3.UP)
	holds("no damage before the start", not world.damage(Vector3.ZERO, 1, 1))
	holds("no state before the start", world.save_state().is_empty() and world.hash_state() == 0)
	holds("it starts", world.start())
	holds("no damage of no energy", not world.damage(Vector3.ZERO, 1, 0))
	holds("no damage where nothing can break", not world.damage(body.position, 1, 1e6))
	holds("no state of something else", not world.restore_state(PackedByteArray([1, 2, 3])))
	holds("no mesh of no fragment", world.get_fragment_mesh(12345) == null)
	holds("no arguments too few", world.callv("damage", [Vector3.ZERO]) == null)
	holds("none of a wrong type", world.callv("step", ["ten"]) == null)
	holds("it still runs", world.step(1))
	world.free()
