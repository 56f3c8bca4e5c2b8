# The demo as it is: what breaks, what signals say, what fragments are, and that the same happens again.
extends "res://checks.gd"

var _told := {"fractured": [], "impact": [], "pane": []}


func check() -> void:
	var demo: Node3D = load("res://demo.tscn").instantiate()
	var world: BrittleWorld3D = demo.get_node("World")
	var pane: BrittleBody3D = demo.get_node("World/Pane")
	world.fractured.connect(func(body: BrittleBody3D, place: Vector3, normal: Vector3, speed: float, energy: float, count: int,
			by: BrittleBody3D, copy: int) -> void: _told.fractured.append([body, place, normal, speed, energy, count, by, copy]))
	world.impact.connect(func(body: BrittleBody3D, _place: Vector3, _normal: Vector3, _speed: float, energy: float,
			_by: BrittleBody3D, _copy: int) -> void: _told.impact.append([body, energy]))
	pane.fractured.connect(func(_place: Vector3, _normal: Vector3, _speed: float, _energy: float, count: int, _by: BrittleBody3D,
			_copy: int) -> void: _told.pane.append(count))
	root.add_child(demo)
	await _check_break(world, pane, demo.get_node("World/Ball"))
	_check_fragments(world, pane)
	await _check_again(world, pane)
	demo.free()


func _check_break(world: BrittleWorld3D, pane: BrittleBody3D, ball: BrittleBody3D) -> void:
	await frames(2)
	holds("the world starts by itself", world.is_started())
	holds("nothing is broken yet", pane.is_whole(0) and world.get_fragment_count() == 0)
	for _k in 30:
		if world.get_fragment_count() > 0:
			break
		await frames(1)
	holds("the ball has flown to it", ball.global_position.z < 0.1)
	holds("the world's signal tells of one break", _told.fractured.size() == 1)
	holds("the pane's signal does as well", _told.pane.size() == 1)
	var told: Array = _told.fractured[0]
	holds("of the pane, by the ball", told[0] == pane and told[6] == ball and told[7] == 0)
	holds("at the pane's face", absf(told[1].z) < 0.004 and told[1].distance_to(Vector3(0.08, 0.78, 0)) < 0.05)
	near("from the side of the ball", told[2].z, 1, 0.01)
	holds("as fast as the ball was", told[3] > 4 and told[3] < 20)
	holds("cracks cost energy, less than the blow had", told[4] > 0 and told[4] < _told.impact[0][1])
	holds("into as many as there are", told[5] == world.get_fragment_count() and told[5] == _told.pane[0] and told[5] > 20)
	holds("the pane is not whole", not pane.is_whole(0))


func _check_fragments(world: BrittleWorld3D, pane: BrittleBody3D) -> void:
	var ids := world.get_fragments()
	holds("fragments have names of their own", ids.size() == world.get_fragment_count())
	var box := AABB(pane.global_position - Vector3(0.45, 0.35, 0.1), Vector3(0.9, 0.7, 0.2))
	var placed := 0
	var looks := {"outer": pane.get_active_material(0), "cut": pane.brittle_material.cut_material}
	var seen := {"outer": 0, "cut": 0}
	for id in ids:
		var mesh := world.get_fragment_mesh(id)
		placed += int(box.has_point(world.get_fragment_transform(id).origin) and world.get_fragment_body(id) == pane)
		for surface in mesh.get_surface_count():
			var name := mesh.surface_get_name(surface)
			seen[name] += int(mesh.surface_get_material(surface) == looks[name])
	holds("they lie where the pane was", placed == ids.size())
	holds("all have faces of cuts, of the material for those", seen.cut == ids.size())
	holds("most have a part of the pane's own surface, of its material", seen.outer > ids.size() / 2)
	near("closed, and as much glass as before", volume_of_fragments(world), 0.8 * 0.6 * 0.006, 6e-9)


# State, hash, restart.
func _check_again(world: BrittleWorld3D, pane: BrittleBody3D) -> void:
	world.active = false
	await frames(1)
	holds("made anew it is as before", world.restart() and pane.is_whole(0) and world.get_fragment_count() == 0)
	holds("steps by hand", world.step(10))
	var state := world.save_state()
	var count := world.get_fragment_count()
	var first := world.hash_state()
	world.step(20)
	var later := world.hash_state()
	holds("it goes on", later != first)
	holds("an earlier state is restored", world.restore_state(state) and world.hash_state() == first)
	holds("with what was broken then", world.get_fragment_count() == count)
	world.step(20)
	holds("what follows is what followed then", world.hash_state() == later)
	world.restart()
	world.step(10)
	holds("what happens anew is what happened", world.hash_state() == first)
