// SPDX-License-Identifier: GPL-2.0-or-later
/// The file of --stats.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "gmsh/support.hpp"

using namespace qmorph::test;
using nlohmann::json;

TEST_CASE("stats: the figures of each surface and of all, and what was asked for") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const std::string stats = directory / "stats.json";
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--stats", stats}).status == 0);
  const json report = json::parse(read_file(stats));
  const Snapshot after = read_snapshot(directory / "out.msh");

  CHECK(report["program"] == "qmorph");
  CHECK(report["exit_status"] == 0);
  CHECK(report["input"] == directory / "in.msh");
  CHECK(report["arguments"].size() == 5);
  for (const char* stage : {"open", "mesh", "read", "convert", "check", "replace", "write", "total"})
    CHECK(report["seconds"][stage].get<double>() >= 0);

  REQUIRE(report["surfaces"].size() == 2);
  std::size_t quads = 0;
  for (const json& surface : report["surfaces"]) {
    const auto counts = element_counts(after, surface["tag"].get<int>());
    CHECK(surface["outcome"] == "converted");
    CHECK(surface["after"]["triangles"] == counts.first);
    CHECK(surface["after"]["quads"] == counts.second);
    CHECK(surface["quality"]["inverted"] == 0);
    quads += counts.second;
  }
  CHECK(report["surfaces"][0]["name"] == "left");
  CHECK(report["total"]["quads"] == quads);
  const json& total = report["total"];
  CHECK(total["scaled_jacobian"]["min"].get<double>() > 0);
  CHECK(total["scaled_jacobian"]["mean"].get<double>() <= 1);
  for (const char* key :
       {"eta", "thesis_metric", "angle_deg", "irregular_share", "valence_interior", "valence_boundary"})
    CHECK(total.contains(key));
}

TEST_CASE("stats: a table of the stages, for each surface and in total") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--stats", directory / "s.json"}).status == 0);
  const json report = json::parse(read_file(directory / "s.json"));
  const json& stages = report["stages"];
  REQUIRE(stages.size() == 7);
  CHECK(stages[0]["stage"] == "input");
  CHECK(stages[6]["stage"] == "repair");
  CHECK(stages[6]["quads"] == report["total"]["quads"]);
  CHECK(stages[6]["scaled_jacobian"]["min"] == report["total"]["scaled_jacobian"]["min"]);
  std::size_t triangles = 0;
  for (const json& surface : report["surfaces"]) {
    CHECK(surface["engine"]["stages"][0]["triangles"] == surface["before"]["triangles"]);
    triangles += surface["before"]["triangles"].get<std::size_t>();
  }
  CHECK(stages[0]["triangles"] == triangles);
}

TEST_CASE("stats: a surface that was left says why it was") {
  const TemporaryDirectory directory;
  std::vector<std::string> elements = {"2 2 0 1 1 2 3", "2 2 0 1 1 2 4", "2 2 0 1 1 2 3"};
  write_file(directory / "in.msh", msh22({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, elements));
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--stats", directory / "s.json"}).status == 3);
  const json report = json::parse(read_file(directory / "s.json"));
  CHECK(report["exit_status"] == 3);
  CHECK(report["surfaces"][0]["outcome"] == "left as it was");
  CHECK(report["surfaces"][0]["reason"].get<std::string>().find("an element twice") != std::string::npos);
  CHECK((read_file(directory / "in.msh") == read_file(directory / "out.msh")));
}
