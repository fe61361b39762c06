// A sphere made by OpenCASCADE: one surface, with a seam and two poles that must not show in the mesh.
DefineConstant[ radius = 1, size = 0.1 ];

SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, radius};
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;

Physical Surface("sphere") = {1};
