// Spur gear with straight flanks and a bore with a keyway: many concave corners, one row of quads around each tooth.
DefineConstant[ teeth = 18, root = 0.8, tip = 1, bore = 0.3, key = 0.09, size = 0.035 ];

step = 2 * Pi / teeth;
outline[] = {};
first = newp;
For i In {0:teeth - 1}
  // Two points on the root circle, two on the tip circle.
  p = newp;
  Point(p) = {root * Cos((i - 0.30) * step), root * Sin((i - 0.30) * step), 0, size};
  Point(p + 1) = {tip * Cos((i - 0.15) * step), tip * Sin((i - 0.15) * step), 0, size};
  Point(p + 2) = {tip * Cos((i + 0.15) * step), tip * Sin((i + 0.15) * step), 0, size};
  Point(p + 3) = {root * Cos((i + 0.30) * step), root * Sin((i + 0.30) * step), 0, size};
EndFor
last = newp - 1;
centre = newp;
Point(centre) = {0, 0, 0};
tips[] = {};
For i In {0:teeth - 1}
  p = first + 4 * i;
  next = p + 4;
  If (i == teeth - 1)
    next = first;
  EndIf
  c = newc;
  Line(c) = {p, p + 1};
  Circle(c + 1) = {p + 1, centre, p + 2};
  Line(c + 2) = {p + 2, p + 3};
  Circle(c + 3) = {p + 3, centre, next};
  outline[] += {c:c + 3};
  tips[] += {c + 1};
EndFor
Curve Loop(1) = outline[];

// The keyway is a rectangle on top of the bore.
a = Asin(key / bore);
p = newp;
Point(p) = {key, bore * Cos(a), 0, size};
Point(p + 1) = {key, bore + key, 0, size};
Point(p + 2) = {-key, bore + key, 0, size};
Point(p + 3) = {-key, bore * Cos(a), 0, size};
Point(p + 4) = {0, -bore, 0, size};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Point(p + 5) = {-bore, 0, 0, size};
Point(p + 6) = {bore, 0, 0, size};
Circle(c + 3) = {p + 3, centre, p + 5};
Circle(c + 4) = {p + 5, centre, p + 4};
Circle(c + 5) = {p + 4, centre, p + 6};
Circle(c + 6) = {p + 6, centre, p};
Curve Loop(2) = {c:c + 6};

Plane Surface(1) = {1, 2};
Physical Curve("tips") = tips[];
Physical Curve("shaft") = {c:c + 6};
Physical Surface("gear") = {1};
