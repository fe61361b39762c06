// SPDX-License-Identifier: GPL-2.0-or-later
/// --depfile: what make has to watch.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "gmsh/read/sources.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("depfile: every file that the geometry includes, merges or takes something from") {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "parts");
  write_file(directory / "parts/size.geo", "size = 0.3;\n");
  write_file(directory / "parts/all.geo",
             "For i In {1:1}\n  Include Sprintf(\"size%g.geo\", i);\nEndFor\nInclude \"size.geo\";\n");
  write_file(directory / "parts/size1.geo", "one = 1;\n");
  write_file(directory / "table.txt", "1 2 3\n");
  write_file(directory / "silent.geo", "quiet = 1;\n");
  write_file(directory / "in.geo.opt", "Mesh.Smoothing = 2;\n");
  write_file(directory / "my.opt", "Mesh.Smoothing = 3;\n");
  write_file(directory / "size.pos", "View \"size\" { SP(0, 0, 0){0.3}; };\n");
  make_msh(directory / "part.msh", 4.1, false, build_two_squares);
  write_file(directory / "in.geo",
             "Merge \"part.msh\";\nInclude \"parts/all.geo\";\nSetFactory(\"OpenCASCADE\");\nRectangle(91) = {5, 0, 0, "
             "1, 1};\n"
             "list() = ListFromFile(\"table.txt\");\nMesh.MeshSizeMax = size;\n"
             "General.Verbosity = 0;\nInclude \"silent.geo\";\nSave \"saved.msh\";\n");
  const std::string out = directory / "out.msh", rule = directory / "out.d";
  const Result result =
      run_qmorph({directory / "in.geo", "-o", out, "-option", directory / "my.opt", "--depfile", rule});
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  const std::string text = read_file(rule);
  CAPTURE(text);
  CHECK(text.compare(0, out.size() + 2, fmt::format("{}: ", out)) == 0);
  for (const char* name : {"in.geo", "parts/all.geo", "parts/size.geo", "parts/size1.geo", "table.txt", "part.msh",
                           "silent.geo", "in.geo.opt", "my.opt"}) {
    CAPTURE(std::string(name));
    CHECK(mentions(text, fmt::format(" \\\n  {}", directory / name)));
    if (name != std::string("in.geo")) CHECK(mentions(text, fmt::format("\n{}:\n", directory / name)));
  }
  CHECK(!mentions(text, "saved.msh"));
}

TEST_CASE("depfile: background meshes and merged files") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n");
  write_file(directory / "groups.geo", "Physical Surface(\"all\", 1) = {1};\n");
  write_file(directory / "size.pos",
             "View \"size\" { ST(0,0,0, 1,0,0, 1,1,0){0.3,0.3,0.3}; ST(0,0,0, 1,1,0, 0,1,0){0.3,0.3,0.3}; };\n");
  const Result result = run_qmorph({directory / "in.geo", directory / "groups.geo", "-bgm", directory / "size.pos",
                                    "-o", directory / "out.msh", "--depfile", directory / "out.d"});
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  for (const char* name : {"in.geo", "groups.geo", "size.pos"})
    CHECK(mentions(read_file(directory / "out.d"), directory / name));
}

TEST_CASE("depfile: make builds again when an included file is newer, and not otherwise") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo",
             "Include \"size.geo\";\nSetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n");
  write_file(directory / "size.geo", "Mesh.MeshSizeMax = 0.3;\n");
  write_file(directory / "Makefile", std::string("out.msh: in.geo\n\techo run >>log\n\t") + QMORPH_COMMAND +
                                         " in.geo -v 0 -o out.msh --depfile out.d\n-include out.d\n");
  const auto make = [&] { return std::system(("make -s -C '" + (directory / ".") + "' >/dev/null 2>&1").c_str()); };
  if (std::system("make --version >/dev/null 2>&1") != 0) return;
  CHECK(make() == 0);
  CHECK(make() == 0);
  CHECK(read_file(directory / "log") == "run\n");
  std::filesystem::last_write_time(directory / "size.geo",
                                   std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
  CHECK(make() == 0);
  CHECK(read_file(directory / "log") == "run\nrun\n");
  write_file(directory / "in.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n");
  std::filesystem::remove(directory / "size.geo");
  CHECK(make() == 0);  // a file that is gone, and that nobody includes any more
}

TEST_CASE("depfile: names with blanks and characters that are special to make") {
  CHECK(adapter::make_rule("a b.msh", {"x#1.geo", "c:d$e.geo"}) ==
        "a\\ b.msh: \\\n  x\\#1.geo \\\n  c\\:d$$e.geo\n\nc\\:d$$e.geo:\n");
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", "Point(1) = {0, 0, 0};\n");
  CHECK(run_qmorph({directory / "in.geo", "-o", "-", "--depfile", directory / "d"}).status == 1);
  CHECK(run_qmorph({directory / "in.geo", "--check", "--depfile", directory / "d"}).status == 1);
  CHECK(run_qmorph({directory / "in.geo", "-o", directory / "d", "-format", "msh", "--depfile", directory / "d"})
            .status == 1);
}
