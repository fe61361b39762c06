// A link made by OpenCASCADE booleans: union, difference, and a fragment that splits the part in two materials.
SetFactory("OpenCASCADE");
DefineConstant[ length = 2, size = 0.04 ];

Disk(1) = {0, 0, 0, 0.5};
Disk(2) = {length, 0, 0, 0.35};
Rectangle(3) = {0, -0.22, 0, length, 0.44};
body() = BooleanUnion{ Surface{1}; Delete; }{ Surface{2, 3}; Delete; };

h = newreg;
Disk(h) = {0, 0, 0, 0.28};
Disk(h + 1) = {length, 0, 0, 0.18};
Rectangle(h + 2) = {0.75, -0.08, 0, 0.6, 0.16, 0.06}; // a window with rounded corners
body() = BooleanDifference{ Surface{body()}; Delete; }{ Surface{h:h + 2}; Delete; };

// The half beyond x = 1.6 is of another material and shares the cut.
cut = newreg;
Rectangle(cut) = {1.6, -1, 0, 2, 2};
half() = BooleanIntersection{ Surface{body()}; }{ Surface{cut}; Delete; };
parts() = BooleanFragments{ Surface{body()}; Delete; }{ Surface{half()}; Delete; };

MeshSize{ PointsOf{ Surface{:}; } } = size;
Mesh.MeshSizeFromCurvature = 40;
Mesh.MeshSizeMin = size / 3;
right() = Surface In BoundingBox{1.5, -1, -1, 3, 1, 1};
left() = Surface{:};
left() -= {right()};
Physical Surface("steel") = left();
Physical Surface("brass") = right();
rim() = Abs(CombinedBoundary{ Surface{:}; });
Physical Curve("rim") = rim();
