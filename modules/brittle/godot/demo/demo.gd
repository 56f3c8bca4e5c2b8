# A ball breaks a window pane and hits what stands behind it. A click strikes the pane where it is clicked on, the space bar
# begins anew.
extends Node3D

@onready var world: BrittleWorld3D = $World


func _ready() -> void:
	world.fractured.connect(_on_fractured)


func _on_fractured(body: BrittleBody3D, position: Vector3, _normal: Vector3, speed: float, energy: float, fragments: int,
		_by: BrittleBody3D, _copy: int) -> void:
	print("%s broke into %d at %v, hit at %.1f m/s; its cracks cost %.3f J" % [body.name, fragments, position, speed, energy])


func _unhandled_input(event: InputEvent) -> void:
	if event.is_action_pressed("ui_accept"):
		world.restart()
	elif event is InputEventMouseButton and event.pressed:
		_strike(event.position)


# Where the ray through the mouse meets the pane's plane.
func _strike(mouse: Vector2) -> void:
	var camera := get_viewport().get_camera_3d()
	var place: Variant = Plane(Vector3.BACK, 0.0).intersects_ray(camera.project_ray_origin(mouse), camera.project_ray_normal(mouse))
	if place != null and world.is_started():
		world.damage(place, 0.02, 1.0)
