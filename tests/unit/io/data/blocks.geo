// gmsh -2 blocks.geo -order 2 -format msh22|msh41 [-bin]   (Gmsh 4.8.4)
// A square of quad9 with a roof of tri6, a loose line, overlapping and reversed groups, groups
// without name, an entity in no group.
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};
Point(5) = {0.5, 2, 0, 1}; Point(6) = {-1, -0.5, 0, 1}; Point(7) = {2, -0.5, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5};
Line(6) = {5, 4}; Line(7) = {6, 7};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(10) = {1};
Curve Loop(2) = {-3, 5, 6}; Plane Surface(20) = {2};
Transfinite Curve {1, 2, 3, 4} = 3; Transfinite Curve {5, 6, 7} = 2;
Transfinite Surface {10}; Recombine Surface {10};
Physical Surface("block") = {10}; Physical Surface(77) = {20}; Physical Surface("all") = {10, 20};
Physical Curve("bottom edge") = {1}; Physical Curve("rim") = {1, -2}; Physical Curve(9) = {5};
Physical Curve("rigid") = {-7};
Physical Point("A") = {5}; Physical Point(33) = {1};
