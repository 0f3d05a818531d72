// Samples for test_gmsh_solids.cpp: a brick, a wedge on top of its right half and a tetrahedron
// beside them. Written with Gmsh 4.8.4, by order (1, 2 with wedge = 0, 2 with incomplete cells):
//   gmsh solids.geo -3 -format msh22|msh41 [-bin] -o solids_1_22.msh
//   gmsh solids.geo -setnumber wedge 0 -3 -order 2 -format ... -o solids_2_22.msh
//   gmsh solids.geo -setnumber Mesh.SecondOrderIncomplete 1 -3 -order 2 ... -o solids_3_22.msh
DefineConstant[ wedge = 1 ];
Mesh.MeshSizeMin = 9;
Mesh.Algorithm3D = 1;

Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 1.2, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 3;
Transfinite Curve {2, 4} = 2;
Transfinite Surface {1};
Recombine Surface {1};
brick[] = Extrude {0, 0, 0.7} { Surface{1}; Layers{1}; Recombine; };
Physical Volume("brick", 5) = {brick[1]};
Physical Surface("floor", 7) = {1};
Physical Surface("roof", 8) = {brick[0]};
Physical Surface(9) = {1, brick[2]};
Physical Curve("rim", 3) = {1};
Physical Point("A", 2) = {3};

If (wedge)
  Point(31) = {0, 0, 2};
  Point(32) = {1, 0, 2};
  Point(33) = {0, 1, 2};
  Line(31) = {31, 32};
  Line(32) = {32, 33};
  Line(33) = {33, 31};
  Curve Loop(31) = {31, 32, 33};
  Plane Surface(31) = {31};
  Transfinite Curve {31, 32, 33} = 2;
  Transfinite Surface {31};
  prism[] = Extrude {0.1, 0, 1} { Surface{31}; Layers{2}; Recombine; };
  Physical Volume("prism", 6) = {prism[1]};
  Physical Surface("slope", 10) = {prism[3]};
EndIf

Point(51) = {5, 0, 0};
Point(52) = {6, 0, 0};
Point(53) = {5, 1, 0};
Point(54) = {5, 0, 1};
Line(51) = {51, 52};
Line(52) = {52, 53};
Line(53) = {53, 51};
Line(54) = {51, 54};
Line(55) = {52, 54};
Line(56) = {53, 54};
Curve Loop(51) = {51, 52, 53};
Plane Surface(51) = {51};
Curve Loop(52) = {51, 55, -54};
Plane Surface(52) = {52};
Curve Loop(53) = {52, 56, -55};
Plane Surface(53) = {53};
Curve Loop(54) = {53, 54, -56};
Plane Surface(54) = {54};
Surface Loop(51) = {51, 52, 53, 54};
Volume(51) = {51};
Transfinite Curve {51, 52, 53, 54, 55, 56} = 2;
Physical Volume("tet", 11) = {51};
Physical Surface("faces", 12) = {51, 52, 53, 54};
