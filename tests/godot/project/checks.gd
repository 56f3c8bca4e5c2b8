# What a script of checks is made of: runs its coroutine `check`, counts what holds, and ends the engine with 1 where something
# does not.
extends SceneTree

var _held := 0
var _failed := 0


func _initialize() -> void:
	_run.call_deferred()


func _run() -> void:
	await check()
	print("%d checks hold, %d do not" % [_held, _failed])
	quit(1 if _failed > 0 or _held == 0 else 0)


func check() -> void:
	pass


func holds(what: String, condition: bool) -> void:
	if condition:
		_held += 1
	else:
		_failed += 1
		print("DOES NOT HOLD: ", what)


func near(what: String, value: float, expected: float, slack: float) -> void:
	holds("%s: %s, expected %s within %s" % [what, value, expected, slack], absf(value - expected) <= slack)


func frames(count: int) -> void:
	for _k in count:
		await physics_frame
	await process_frame


func new_world() -> BrittleWorld3D:
	var world := BrittleWorld3D.new()
	world.active = false
	root.add_child(world)
	return world


func new_material(like: String) -> BrittleMaterial:
	var material := BrittleMaterial.new()
	material.like = like
	return material


func new_body(world: BrittleWorld3D, mesh: Mesh, place: Vector3, like := "") -> BrittleBody3D:
	var body := BrittleBody3D.new()
	body.mesh = mesh
	body.position = place
	if like != "":
		body.brittle_material = new_material(like)
	world.add_child(body)
	return body


func new_floor(world: BrittleWorld3D) -> BrittleBody3D:
	var body := BrittleBody3D.new()
	body.kind = BrittleBody3D.KIND_COLLIDER
	body.shape = BrittleBody3D.SHAPE_PLANE
	world.add_child(body)
	return body


# The corners of all triangles, by their arrays: Mesh.get_faces rounds to a tenth of a millimeter.
func corners_of(mesh: Mesh) -> PackedVector3Array:
	var corners := PackedVector3Array()
	for surface in mesh.get_surface_count():
		var arrays := mesh.surface_get_arrays(surface)
		var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
		if arrays[Mesh.ARRAY_INDEX] == null:
			corners.append_array(vertices)
		else:
			for index: int in arrays[Mesh.ARRAY_INDEX]:
				corners.append(vertices[index])
	return corners


# The volume that a mesh encloses whose front faces, clockwise here, look outward; NAN where an edge is open.
func volume_of(mesh: Mesh) -> float:
	var faces := corners_of(mesh)
	var edges := {}
	var volume := 0.0
	for k in range(0, faces.size(), 3):
		var corners := [faces[k], faces[k + 2], faces[k + 1]]
		volume += corners[0].dot(corners[1].cross(corners[2])) / 6.0
		for c in 3:
			var from: Vector3 = corners[c]
			var to: Vector3 = corners[(c + 1) % 3]
			if from != to:
				edges[[from, to]] = edges.get([from, to], 0) + 1
				edges[[to, from]] = edges.get([to, from], 0) - 1
	for edge: Array in edges:
		if edges[edge] != 0:
			return NAN
	return volume


func volume_of_fragments(world: BrittleWorld3D) -> float:
	var volume := 0.0
	for id in world.get_fragments():
		volume += volume_of(world.get_fragment_mesh(id))
	return volume
