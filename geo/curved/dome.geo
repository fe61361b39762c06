// A dome with a round hole beside its top: shells for a roof. `qmorph -2 dome.geo -order 2 --for calculix` makes a deck of S8.
DefineConstant[ radius = 10, hole = 2.5, shift = 4, size = 0.7 ];

SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, radius, 0, Pi / 2};
skin() = Boundary{ Volume{1}; };
Delete { Volume{1}; }
Recursive Delete { Surface{skin(1)}; }  // the floor
Cylinder(2) = {shift, 0, 0, 0, 0, 2 * radius, hole};
BooleanDifference(10) = { Surface{skin(0)}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;

e = 1e-3 * radius;
Physical Curve("ground") = Curve In BoundingBox {-radius - e, -radius - e, -e, radius + e, radius + e, e};
Physical Curve("hole") = Curve In BoundingBox {shift - hole - e, -hole - e, e, shift + hole + e, hole + e, radius};
Physical Surface("dome") = {10};
