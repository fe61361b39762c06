// Block with thin slots that stop just short of each other and of the edge: gaps one or two elements wide.
DefineConstant[ slots = 6, slot = 0.02, wall = 0.035, size = 0.045 ];

width = 2;
height = 1;
Point(1) = {0, 0, 0, size};
Point(2) = {width, 0, 0, size};
Point(3) = {width, height, 0, size};
Point(4) = {0, height, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};

holes[] = {};
edges[] = {};
pitch = width / (slots + 1);
For i In {1:slots}
  // Every other slot comes from above.
  x = i * pitch;
  low = wall;
  high = height - 3 * wall;
  If (i % 2)
    low = 3 * wall;
    high = height - wall;
  EndIf
  p = newp;
  Point(p) = {x - slot / 2, low, 0, size / 2};
  Point(p + 1) = {x + slot / 2, low, 0, size / 2};
  Point(p + 2) = {x + slot / 2, high, 0, size / 2};
  Point(p + 3) = {x - slot / 2, high, 0, size / 2};
  c = newc;
  Line(c) = {p, p + 1};
  Line(c + 1) = {p + 1, p + 2};
  Line(c + 2) = {p + 2, p + 3};
  Line(c + 3) = {p + 3, p};
  loop = newreg;
  Curve Loop(loop) = {c:c + 3};
  holes[] += {loop};
  edges[] += {c:c + 3};
  If (i < slots) // a second, shorter slot beside the first leaves a wall of one element
    p = newp;
    Point(p) = {x + slot / 2 + wall, 0.4, 0, size / 2};
    Point(p + 1) = {x + 1.5 * slot + wall, 0.4, 0, size / 2};
    Point(p + 2) = {x + 1.5 * slot + wall, 0.6, 0, size / 2};
    Point(p + 3) = {x + slot / 2 + wall, 0.6, 0, size / 2};
    c = newc;
    Line(c) = {p, p + 1};
    Line(c + 1) = {p + 1, p + 2};
    Line(c + 2) = {p + 2, p + 3};
    Line(c + 3) = {p + 3, p};
    loop = newreg;
    Curve Loop(loop) = {c:c + 3};
    holes[] += {loop};
    edges[] += {c:c + 3};
  EndIf
EndFor

Plane Surface(1) = {1, holes[]};
Physical Curve("outside") = {1:4};
Physical Curve("slots") = edges[];
Physical Surface("block") = {1};
