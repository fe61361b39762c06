// Remeshing a survey: the facets of terrain.stl (see terrain.py) become a parametrised surface, which is meshed anew.
DefineConstant[ size = 40 ];

Merge "terrain.stl";
ClassifySurfaces{40 * Pi / 180, 1, 1, 40 * Pi / 180};
CreateGeometry;
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;

Physical Surface("terrain") = Surface{:};
Physical Curve("edge") = Curve{:};
