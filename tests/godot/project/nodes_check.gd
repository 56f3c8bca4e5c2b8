# Nodes by themselves: what the editor is told, shapes, meshes of the engine's, copies, damage by hand, and nodes that go.
extends "res://checks.gd"


func check() -> void:
	_check_classes()
	_check_scene_file()
	_check_shapes()
	_check_primitives()
	_check_transforms()
	_check_copies()
	_check_damage()
	_check_drops()
	await _check_ends()


func _property(object: Object, property: String) -> Dictionary:
	for entry in object.get_property_list():
		if entry.name == property:
			return entry
	return {}


func _check_classes() -> void:
	holds("a body is a MeshInstance3D", ClassDB.is_parent_class("BrittleBody3D", "MeshInstance3D"))
	holds("a world is a Node3D", ClassDB.is_parent_class("BrittleWorld3D", "Node3D"))
	holds("a material is a resource", ClassDB.is_parent_class("BrittleMaterial", "Resource"))
	var world := BrittleWorld3D.new()
	var effects := _property(world, "effects")
	holds("effects are flags", effects.hint == PROPERTY_HINT_FLAGS and "Impact fracture:64" in effects.hint_string)
	holds("gravity has its unit", "m/s²" in _property(world, "gravity").hint_string)
	near("gravity is Earth's", world.gravity.y, -9.81, 0.01)
	near("steps are a sixtieth of a second", world.step_seconds, 1.0 / 60, 1e-9)
	holds("things break unless told otherwise", world.effects & BrittleWorld3D.EFFECT_IMPACT_FRACTURE != 0)
	var body := BrittleBody3D.new()
	holds("a body's material is chosen by class", _property(body, "brittle_material").hint_string == "BrittleMaterial")
	holds("shapes have names", _property(body, "shape").hint == PROPERTY_HINT_ENUM)
	var material := BrittleMaterial.new()
	holds("materials have names", "porcelain" in _property(material, "like").hint_string and material.like == "glass")
	material.density = 2000
	near("numbers stay", material.density, 2000, 0)
	for signal_name: String in ["fractured", "impact"]:
		holds("both nodes have the signal " + signal_name, world.has_signal(signal_name) and body.has_signal(signal_name))
	world.free()
	body.free()


# What a scene file keeps of a node.
func _check_scene_file() -> void:
	var body := BrittleBody3D.new()
	body.brittle_material = new_material("ice")
	body.mass = 3
	body.kind = BrittleBody3D.KIND_FIXED
	body.linear_velocity = Vector3(1, 2, 3)
	var scene := PackedScene.new()
	scene.pack(body)
	ResourceSaver.save(scene, "res://kept.tscn")
	var kept: BrittleBody3D = load("res://kept.tscn").instantiate()
	holds("a scene file keeps a body", kept.mass == 3 and kept.kind == BrittleBody3D.KIND_FIXED
			and kept.linear_velocity == Vector3(1, 2, 3) and kept.brittle_material.like == "ice")
	body.free()
	kept.free()


# Each of them comes to rest on the floor as high as its shape says.
func _check_shapes() -> void:
	var world := new_world()
	new_floor(world)
	var box := BoxMesh.new()
	box.size = Vector3(0.4, 0.3, 0.4)
	var ball := SphereMesh.new()
	ball.radius = 0.2
	ball.height = 0.4
	var bodies: Array[BrittleBody3D] = []
	for shape in [BrittleBody3D.SHAPE_MESH, BrittleBody3D.SHAPE_HULL, BrittleBody3D.SHAPE_BOX]:
		bodies.append(new_body(world, box, Vector3(bodies.size(), 0.2, 0)))
		bodies[-1].shape = shape
	bodies.append(new_body(world, ball, Vector3(4, 0.25, 0)))
	bodies[-1].shape = BrittleBody3D.SHAPE_BALL
	holds("they start", world.start())
	world.step(90)
	for k in 3:
		near("shape %d rests on its face" % k, bodies[k].global_position.y, 0.15, 0.005)
	near("the ball on what is lowest of it", bodies[3].global_position.y, 0.2, 0.03)
	world.free()


# The engine's own meshes are solids, as they are.
func _check_primitives() -> void:
	for primitive: PrimitiveMesh in [BoxMesh.new(), SphereMesh.new(), CylinderMesh.new(), CapsuleMesh.new(), TorusMesh.new(),
			PrismMesh.new()]:
		var world := new_world()
		new_floor(world)
		var body := new_body(world, primitive, Vector3(0, 1.5, 0), "glass")
		holds("%s is a body" % primitive.get_class(), world.start())
		world.step(1)
		world.damage(body.global_position + Vector3(primitive.get_aabb().end.x, 0, 0), 0.3, 5e4)
		world.step(2)
		holds("%s breaks" % primitive.get_class(), world.get_fragment_count() > 1)
		var volume := volume_of(primitive)
		near("%s keeps its volume" % primitive.get_class(), volume_of_fragments(world), volume, 2e-6 * volume)
		world.free()


# Scale, shear and mirroring are part of the shape, and stay part of the node.
func _check_transforms() -> void:
	var world := new_world()
	new_floor(world)
	var box := BoxMesh.new()
	var basis := Basis(Vector3(0.5, 0, 0), Vector3(0.1, 0.25, 0), Vector3(0, 0, -0.75))
	var body := new_body(world, box, Vector3(0, 0.125, 0), "glass")
	body.basis = basis
	world.step(30)
	holds("it keeps its basis", body.basis.is_equal_approx(basis))
	near("and rests as low as that is", body.position.y, 0.125, 0.003)
	world.damage(body.position, 0.3, 200)
	world.step(2)
	holds("it breaks", world.get_fragment_count() > 1)
	near("into its volume", volume_of_fragments(world), absf(basis.determinant()), 2e-6 * absf(basis.determinant()))
	world.free()


func _check_copies() -> void:
	var world := new_world()
	new_floor(world)
	var blocks := MultiMesh.new()
	blocks.transform_format = MultiMesh.TRANSFORM_3D
	blocks.mesh = BoxMesh.new()
	blocks.mesh.size = Vector3(0.2, 0.2, 0.2)
	blocks.use_colors = true
	blocks.instance_count = 3
	var buffer := PackedFloat32Array()
	for k in 3:
		buffer.append_array([1, 0, 0, k, 0, 1, 0, 0.1, 0, 0, 1, 0, 1, 1, 1, 1])
	blocks.buffer = buffer
	var body := new_body(world, null, Vector3(5, 0, 0), "porcelain")
	body.copies = blocks
	var copies: Array[int] = []
	body.fractured.connect(func(_p: Vector3, _n: Vector3, _s: float, _e: float, _f: int, _by: BrittleBody3D, copy: int) -> void:
			copies.append(copy))
	holds("copies start", world.start())
	world.step(5)
	world.damage(Vector3(6, 0.1, 0), 0.1, 300)
	world.step(2)
	holds("the one that was hit broke", copies == [1])
	holds("the others did not", body.is_whole(0) and not body.is_whole(1) and body.is_whole(2))
	near("its fragments are its volume", volume_of_fragments(world), 0.008, 2e-8)
	holds("the MultiMesh that was given is as it was", blocks.buffer == buffer)
	world.free()


func _check_damage() -> void:
	var world := new_world()
	new_floor(world)
	var body := new_body(world, BoxMesh.new(), Vector3(0, 0.5, 0), "glass")
	world.start()
	holds("a soft blow is taken", world.damage(body.position, 1, 1e-9))
	world.step(2)
	holds("and breaks nothing", body.is_whole(0))
	world.damage(body.position, 0.1, 1e4)
	world.step(1)
	holds("a hard one breaks it", not body.is_whole(0) and world.get_fragment_count() > 1)
	world.free()


# A plate that falls breaks by itself, and what broke is told to both.
func _check_drops() -> void:
	var world := new_world()
	new_floor(world)
	var plate := CylinderMesh.new()
	plate.height = 0.02
	plate.top_radius = 0.15
	plate.bottom_radius = 0.12
	var body := new_body(world, plate, Vector3(0, 1, 0), "porcelain")
	body.rotation_degrees = Vector3(30, 0, 20)
	var told := [0, 0]
	body.impact.connect(func(_p: Vector3, _n: Vector3, _s: float, _e: float, _by: BrittleBody3D, _c: int) -> void: told[0] += 1)
	body.fractured.connect(func(_p: Vector3, _n: Vector3, _s: float, _e: float, _f: int, _by: BrittleBody3D, _c: int) -> void:
			told[1] += 1)
	world.step(60)
	holds("a dropped plate breaks", told[1] > 0 and not body.is_whole(0))
	holds("every break is an impact", told[0] >= told[1])
	world.free()


# Nodes may go while the world runs, by those who hear of a break as well.
func _check_ends() -> void:
	var world := new_world()
	new_floor(world)
	var one := new_body(world, BoxMesh.new(), Vector3(0, 0.5, 0), "glass")
	var other := new_body(world, BoxMesh.new(), Vector3(3, 0.5, 0), "glass")
	world.start()
	one.free()
	world.damage(Vector3(0, 0.5, 0), 0.1, 1e4)
	holds("it goes on without a node", world.step(2))
	holds("and shows nothing of what has none", world.get_fragment_count() == 0)
	other.fractured.connect(func(_p: Vector3, _n: Vector3, _s: float, _e: float, _f: int, _by: BrittleBody3D, _c: int) -> void:
			world.restart())
	world.damage(other.position, 0.1, 1e4)
	world.step(1)
	holds("whoever hears of a break may begin anew", world.is_started() and other.is_whole(0))
	root.remove_child(world)
	holds("a world that leaves the tree ends", not world.is_started())
	root.add_child(world)
	world.active = true
	await frames(2)
	holds("and starts when it comes back", world.is_started())
	world.queue_free()
	await frames(1)
