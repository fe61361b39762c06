// A pipe with two branches, one of them slanted: the quads of the walls meet along the curves where the pipes meet.
DefineConstant[ radius = 1, branch = 0.6, size = 0.18 ];

SetFactory("OpenCASCADE");
Cylinder(1) = {-4, 0, 0, 8, 0, 0, radius};
Cylinder(2) = {-1.5, 0, 0, 0, 0, 2.5, branch};
Cylinder(3) = {1, 0, 0, 1.5, 2.2, 0, branch};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;

// The flat surfaces are the ends, where the pipes are open.
e = 0.01;
ends() = Surface In BoundingBox {-4 - e, -radius - e, -radius - e, -4 + e, radius + e, radius + e};
ends() += Surface In BoundingBox {4 - e, -radius - e, -radius - e, 4 + e, radius + e, radius + e};
ends() += Surface In BoundingBox {-1.5 - branch - e, -branch - e, 2.5 - e, -1.5 + branch + e, branch + e, 2.5 + e};
ends() += Surface In BoundingBox {1.9, 1.7, -branch - e, 3.1, 2.7, branch + e};
walls() = Surface{:};
walls() -= ends();
Physical Surface("ends") = ends();
Physical Surface("walls") = walls();
