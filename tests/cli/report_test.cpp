// SPDX-License-Identifier: GPL-2.0-or-later
/// The file of --report. What a browser makes of it: tests/pages.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "gmsh/support.hpp"

using namespace qmorph::test;
using nlohmann::json;

namespace {

/// The JSON inside the page.
json facts_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"facts\">";
  const std::size_t at = page.find(begin) + begin.size();
  return json::parse(page.substr(at, page.find("</script>", at) - at));
}

}  // namespace

TEST_CASE("report: one page with both meshes, their groups, the figures and the command") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const std::string path = directory / "r.html";
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--report", path}).status == 0);
  const std::string page = read_file(path);
  CHECK(page.find("{{") == std::string::npos);
  CHECK(page.find("@@") == std::string::npos);
  CHECK(page.find("\nimport ") == std::string::npos);
  CHECK(page.find("\nexport ") == std::string::npos);

  const json facts = facts_of(page);
  const Snapshot after = read_snapshot(directory / "out.msh");
  const json& mesh = facts["meshes"]["after"];
  REQUIRE(mesh["surfaces"].size() == 2);
  std::size_t quads = 0;
  for (const json& surface : mesh["surfaces"]) {
    const auto counts = element_counts(after, surface["tag"].get<int>());
    CHECK(surface["count"] == counts.first + counts.second);
    CHECK(surface["first"] == quads);
    quads += counts.first + counts.second;
  }
  CHECK(mesh["groups"][mesh["surfaces"][0]["groups"][0].get<std::size_t>()]["name"] == "left");
  CHECK(facts["meshes"]["before"]["corner_counts"]["count"] > mesh["corner_counts"]["count"]);
  CHECK(facts["stats"]["stages"].size() == 7);
  CHECK(facts["command"].get<std::string>().rfind("qmorph ", 0) == 0);
}

TEST_CASE("report: a name cannot end the script that it stands in") {
  const TemporaryDirectory directory;
  make_msh(directory / "<script>.msh", 4.1, false, build_two_squares);
  const std::string path = directory / "r.html";
  REQUIRE(run_qmorph({directory / "<script>.msh", "-o", directory / "<!--.msh", "--report", path}).status == 0);
  const std::string page = read_file(path);
  CHECK(page.find("<script>.msh") == std::string::npos);
  CHECK(page.find("<!--.msh") == std::string::npos);
  CHECK(facts_of(page)["stats"]["input"] == directory / "<script>.msh");
}

TEST_CASE("film: one page with the steps of every region; none for a mesh without a front") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const std::string path = directory / "f.html";
  REQUIRE(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--film", path}).status == 0);
  const json facts = facts_of(read_file(path));
  REQUIRE(facts["regions"].size() == 2);
  for (const json& region : facts["regions"]) CHECK(region["step_count"].get<int>() > 5);
  CHECK(run_qmorph({directory / "out.msh", "-o", directory / "again.msh", "--film", path}).status == 0);
  CHECK(facts_of(read_file(path))["regions"].empty());
  CHECK(run_qmorph({directory / "out.msh", "-o", directory / "again.msh", "--film", path, "--cleanup-only"}).status ==
        1);
}

TEST_CASE("report: it does not overwrite another file") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  const std::string in = directory / "in.msh", out = directory / "out.msh", page = directory / "p.html";
  for (const std::string& taken : {in, out, page}) {
    const Result result = run_qmorph({in, "-o", out, "--stats", page, "--report", taken});
    CHECK(result.status == 1);
    CHECK(result.err.find("give it a file of its own") != std::string::npos);
  }
  CHECK(directory.files() == std::vector<std::string>{"in.msh"});
  CHECK(run_qmorph({in, "-o", out, "--report", directory / "no/p.html"}).status == 5);
}
