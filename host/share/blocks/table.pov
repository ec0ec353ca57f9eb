// The room around the blocks: a table under one large lamp and a window, walls of a pale paint. Metres; POV-Ray's y is up,
// so the map's (x, y, z) is <x, z, y> here. The blocks and the camera come from render.py.
#version 3.7;
global_settings {
  assumed_gamma 1
  radiosity { count 120 nearest_count 8 error_bound 0.5 recursion_limit 1 brightness 0.6 pretrace_end 0.02 }
}

#declare Lamp = light_source {
  <1.1, 1.3, 0.5> color rgb <1.0, 0.9, 0.74> * 1.6
  area_light <0.3, 0, 0>, <0, 0, 0.3>, 9, 9 adaptive 2 circular orient
  fade_distance 1.8 fade_power 2
};
#declare Window = light_source {
  <-2.6, 1.3, -1.2> color rgb <0.75, 0.85, 1.0> * 0.25
  area_light <0, 0.9, 0>, <0.5, 0, -0.9>, 9, 9 adaptive 2
  fade_distance 2.5 fade_power 2
};
light_source { Lamp }
light_source { Window }

#declare Matt = finish { ambient 0 diffuse 0.75 specular 0.08 roughness 0.08 };

// Table top of pale wood, 2.6 m across; its edge is in sight.
cylinder {
  <0, -0.03, 0>, <0, 0, 0>, 1.3
  pigment {
    wood turbulence 0.08 scale <0.12, 0.12, 1.5> rotate y * 30
    color_map { [0 rgb <0.55, 0.47, 0.38>] [1 rgb <0.49, 0.41, 0.32>] }
  }
  finish { Matt }
}
// A low block of the table's own wood: no colour to look for, but in some views it hides a foot.
box {
  <-0.04, 0, -0.02>, <0.04, 0.035, 0.02> rotate y * 35 translate <0.25, 0, -0.09>
  pigment { color rgb <0.52, 0.44, 0.35> }
  finish { Matt }
}
// Walls, floor and ceiling.
difference {
  box { <-3.2, -0.75, -3.0>, <3.2, 1.9, 3.0> }
  box { <-3.1, -0.7, -2.9>, <3.1, 1.8, 2.9> }
  pigment { color rgb <0.62, 0.62, 0.6> }
  finish { Matt }
}
// A dark cupboard and a pale door, so that the background is not one colour.
box { <2.6, -0.7, -1.4>, <3.1, 0.9, -0.3> pigment { color rgb <0.16, 0.13, 0.11> } finish { Matt } }
box { <-1.2, -0.7, 2.85>, <-0.3, 1.4, 2.9> pigment { color rgb <0.72, 0.7, 0.66> } finish { Matt } }
