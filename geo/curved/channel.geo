// Flow past a cylinder, one layer of cells thick, for OpenFOAM: `qmorph -3 channel.geo --for openfoam` makes hexahedra of
// the quads; foam_case makes a case of them.
DefineConstant[ length = 2.2, height = 0.41, diameter = 0.1, thickness = 0.05, size = 0.025 ];

SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, length, height};
Disk(2) = {2 * diameter, 2 * diameter, 0, diameter / 2};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Field[1] = MathEval;
Field[1].F = Sprintf("%g + 0.12 * Fabs(Sqrt((x - %g)^2 + (y - %g)^2) - %g)", size / 4, 2 * diameter, 2 * diameter, diameter / 2);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", size);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeExtendFromBoundary = 0;
cells[] = Extrude {0, 0, thickness} { Surface{3}; Layers{1}; Recombine; };

e = 1e-3;
Physical Volume("fluid") = {cells[1]};
Physical Surface("front") = {cells[0]};
Physical Surface("back") = {3};
Physical Surface("inlet") = Surface In BoundingBox {-e, -e, -e, e, height + e, thickness + e};
Physical Surface("outlet") = Surface In BoundingBox {length - e, -e, -e, length + e, height + e, thickness + e};
Physical Surface("walls") = {Surface In BoundingBox {-e, -e, -e, length + e, e, thickness + e},
  Surface In BoundingBox {-e, height - e, -e, length + e, height + e, thickness + e}};
r = diameter / 2;
Physical Surface("cylinder") = Surface In BoundingBox {2 * diameter - r - e, 2 * diameter - r - e, -e,
  2 * diameter + r + e, 2 * diameter + r + e, thickness + e};
