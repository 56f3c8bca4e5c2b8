# The demo on a screen: on the engine's own device it comes to the same, bit for bit, as on one of its own, and fragments are seen
# where they are. Leaves demo_*.png as users see it, and fragments.png with all of them in one plain color.
extends "res://checks.gd"

const PLAIN := Color(1, 0, 1)


func check() -> void:
	var hash_of_engine := await _draw_demo()
	holds("its own device comes to the same", _hash_on_own_device() == hash_of_engine)
	await _find_fragments()
	await _run_by_itself()


func _picture(file: String) -> Image:
	await process_frame
	await RenderingServer.frame_post_draw
	var image := root.get_texture().get_image()
	image.save_png("res://" + file)
	return image


func _draw_demo() -> int:
	var demo: Node3D = load("res://demo.tscn").instantiate()
	root.add_child(demo)
	var world: BrittleWorld3D = demo.get_node("World")
	world.active = false
	world.start()
	print("works on ", world.get_device_name())
	holds("it works on the engine's device", world.is_on_engine_device())
	await _picture("demo_0.png")
	world.step(8)
	await _picture("demo_1.png")
	world.step(22)
	await _picture("demo_2.png")
	var told := world.hash_state()
	demo.free()
	return told


func _hash_on_own_device() -> int:
	var demo: Node3D = load("res://demo.tscn").instantiate()
	root.add_child(demo)
	var world: BrittleWorld3D = demo.get_node("World")
	world.active = false
	world.device = BrittleWorld3D.DEVICE_OWN
	world.step(30)
	holds("that is another device", not world.is_on_engine_device())
	var told := world.hash_state()
	demo.free()
	return told


# Frames do not wait for the render thread, where there is one, and take in what it has done since.
func _run_by_itself() -> void:
	var demo: Node3D = load("res://demo.tscn").instantiate()
	root.add_child(demo)
	await frames(30)
	var world: BrittleWorld3D = demo.get_node("World")
	holds("it runs by itself", world.get_fragment_count() > 100)
	demo.free()


# Without light, so that a pixel of a fragment is of no other color, and with nothing before them. Those of a few pixels may miss the
# middle of one.
func _find_fragments() -> void:
	var plain := StandardMaterial3D.new()
	plain.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	plain.albedo_color = PLAIN
	var demo: Node3D = load("res://demo.tscn").instantiate()
	var pane: BrittleBody3D = demo.get_node("World/Pane")
	pane.material_override = plain
	pane.brittle_material.cut_material = plain
	for node: Node3D in [demo.get_node("World/Frame"), demo.get_node("World/Blocks")]:
		node.free()
	demo.get_node("World/Ball").hide()
	root.add_child(demo)
	var world: BrittleWorld3D = demo.get_node("World")
	world.active = false
	world.step(1)
	var whole := _count(await _picture("whole.png"))
	world.step(14)
	var image := await _picture("fragments.png")
	var large := 0
	var seen := 0
	for id in world.get_fragments():
		var place := _place_of(world, id, image.get_size())
		if place.x >= 0:
			large += 1
			seen += int(image.get_pixelv(place).is_equal_approx(PLAIN))
	print("of %d fragments %d are large enough, %d of these are seen in the middle of them; pixels: %d whole, %d broken" % [
			world.get_fragment_count(), large, seen, whole, _count(image)])
	holds("the whole pane is seen", whole > 10000)
	holds("many fragments are large enough to be seen", large > 100)
	holds("and they are seen in the middle of them", seen >= 0.97 * large)
	world.visible = false
	holds("a world that is not visible shows none", _count(await _picture("hidden.png")) == 0)
	demo.free()


# On the screen, of the middle of a fragment; -1 where it is not there, or is hardly a few pixels long.
func _place_of(world: BrittleWorld3D, id: int, size: Vector2i) -> Vector2i:
	var camera := root.get_camera_3d()
	var middle := world.get_fragment_transform(id).origin
	var reach := world.get_fragment_mesh(id).get_aabb().get_longest_axis_size() / 2
	var place := camera.unproject_position(middle)
	var pixels := place.distance_to(camera.unproject_position(middle + camera.global_basis.x * reach))
	var is_on_screen := Rect2(Vector2.ZERO, size).grow(-2).has_point(place)
	return Vector2i(place) if is_on_screen and pixels > 6 else Vector2i(-1, -1)


func _count(image: Image) -> int:
	var count := 0
	for y in image.get_height():
		for x in image.get_width():
			count += int(image.get_pixel(x, y).is_equal_approx(PLAIN))
	return count
