// Strong grading by size fields, from 0.002 at a corner and 0.01 along an arc to 0.12, so transitions everywhere.
// The fields work with Gmsh 4.8.4 too.
DefineConstant[ fine = 0.002, middle = 0.01, coarse = 0.12 ];

Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 2, 0};
Point(4) = {0, 2, 0};
Point(5) = {2, 1.2, 0};
Point(6) = {1.2, 2, 0};
Line(1) = {1, 2};
Line(2) = {2, 5};
Circle(3) = {5, 3, 6};
Line(4) = {6, 4};
Line(5) = {4, 1};
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};

Field[1] = Distance;
Field[1].PointsList = {1};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = fine;
Field[2].SizeMax = coarse;
Field[2].DistMin = 3 * fine;
Field[2].DistMax = 0.9;
Field[3] = Distance;
Field[3].CurvesList = {3};
Field[3].NumPointsPerCurve = 200;
Field[4] = Threshold;
Field[4].InField = 3;
Field[4].SizeMin = middle;
Field[4].SizeMax = coarse;
Field[4].DistMin = middle;
Field[4].DistMax = 0.7;
Field[5] = Min;
Field[5].FieldsList = {2, 4};
Background Field = 5;
Mesh.MeshSizeExtendFromBoundary = 0; // the fields alone decide
Mesh.MeshSizeFromPoints = 0;

Physical Point("load") = {1};
Physical Curve("notch") = {3};
Physical Surface("corner") = {1};
