// SPDX-License-Identifier: GPL-2.0-or-later
/// What the words of the command line mean.

#include "cli/request/request.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <vector>

#include "cli/request/engine_options.hpp"
#include "qmorph/error.hpp"

using qmorph::Options;
using qmorph::UsageError;
using qmorph::cli::engine_options;
using qmorph::cli::parse;
using qmorph::cli::Request;
using Words = std::vector<std::string>;

TEST_CASE("request: Gmsh's spelling and the usual one") {
  for (const Words& words : {Words{"in.geo", "-o", "out.msh", "-format", "msh2", "-bin", "-v", "3", "-2", "-nt", "4"},
                             Words{"-2", "--o=out.msh", "--format", "msh2", "--bin", "--v", "3", "--nt=4", "in.geo"}}) {
    const Request request = parse(words);
    CHECK(request.input == "in.geo");
    CHECK(request.output == "out.msh");
    CHECK(request.format == "msh2");
    CHECK(request.binary == true);
    CHECK(request.verbosity == 3);
    CHECK(request.gmsh_arguments.empty());
  }
}

TEST_CASE("request: options of Gmsh are passed on in their order") {
  const Request request = parse({"-clmax", "0.1", "in.geo", "-setnumber", "depth", "-3", "-clmin", "1e-3", "-setstring",
                                 "name", "-o", "-algo", "del2d", "-setnumber", "Mesh.MshFileVersion", "2.2"});
  CHECK(request.gmsh_arguments == Words{"-clmax", "0.1", "-setnumber", "depth", "-3", "-clmin", "1e-3", "-setstring",
                                        "name", "-o", "-algo", "del2d", "-setnumber", "Mesh.MshFileVersion", "2.2"});
  CHECK(request.algorithm_chosen);
  CHECK(request.msh_version == 2.2);
  CHECK(request.output.empty());
}

TEST_CASE("request: lists of surfaces") {
  CHECK(parse({"a.msh", "--surfaces", "3,7"}).surfaces == std::vector<int>{3, 7});
  CHECK(parse({"--surfaces=3", "a.msh", "--surfaces", "0"}).surfaces == std::vector<int>{3, 0});
  CHECK(parse({"a.msh"}).surfaces.empty());
}

TEST_CASE("request: constants of the algorithm") {
  CHECK(parse({"a.msh", "--set", "THETAMAX=170", "--set=GAMMA=0.9"}).settings == Words{"THETAMAX=170", "GAMMA=0.9"});
}

TEST_CASE("request: what the engine is told") {
  CHECK(engine_options(parse({"a.msh"})).layers);
  CHECK(!engine_options(parse({"a.msh", "--layers=off"})).layers);
  CHECK(engine_options(parse({"a.msh"})).crease_angle == Options().crease_angle);
  CHECK(engine_options(parse({"a.msh", "--crease", "180"})).crease_angle == doctest::Approx(std::numbers::pi));
  CHECK(engine_options(parse({"a.msh", "-nt", "3"})).threads == 3);
  CHECK(engine_options(parse({"a.msh", "--smoothing", "thesis"})).smoothing.method == qmorph::SmoothingMethod::thesis);
  for (const Words& words : {Words{"--smoothing", "sand"}, Words{"--set", "layers"}, Words{"--set", "layers=x"}})
    CHECK_THROWS_AS(engine_options(parse({"a.msh", words[0], words[1]})), UsageError);
}

TEST_CASE("request: options that would have no effect are refused") {
  const struct {
    Words words;
    const char* message;
  } kCases[] = {
      {{"--max-distance", "1"}, "go with --check"},
      {{"--against", "b.msh"}, "go with --check"},
      {{"--check", "--max-distance", "1"}, "name their mesh: --against FILE"},
      {{"--check", "--max-size-ratio", "2"}, "name their mesh: --against FILE"},
      {{"--check", "--layers", "off"}, "--check changes nothing; leave out --layers"},
      {{"--check", "--crease", "20"}, "--check changes nothing; leave out --crease"},
      {{"--check", "--orient"}, "--check changes nothing; leave out --orient"},
      {{"--check", "--depfile", "b.d"}, "--check writes nothing; leave out --depfile"},
      {{"--check", "-o", "b.msh"}, "--check writes nothing; leave out -o"},
      {{"--cleanup-only", "--layers", "on"}, "--cleanup-only finds quads"},
      {{"--cleanup-only", "--all-quad"}, "--cleanup-only takes curves as they are"},
      {{"--depfile", "b.d", "-o", "-"}, "give -o a name"},
      {{"--stage", "front"}, "are for pictures"},
      {{"--elements", "S"}, "goes with --for"},
      {{"--layers", "some"}, "--layers"},
      {{"--crease", "200"}, "--crease"},
      {{"--crease", "-1"}, "--crease"},
  };
  for (const auto& the_case : kCases) {
    Words words{"a.msh"};
    words.insert(words.end(), the_case.words.begin(), the_case.words.end());
    CAPTURE(words);
    CHECK_THROWS_WITH_AS(parse(words), doctest::Contains(the_case.message), UsageError);
  }
}

TEST_CASE("request: names of files may be odd") {
  CHECK(parse({"a b.geo"}).input == "a b.geo");
  CHECK(parse({"a=b.geo", "-o", "c=d.msh"}).output == "c=d.msh");
  CHECK(parse({"a.geo", "-o", "-x.msh"}).output == "-x.msh");
  CHECK(parse({"ä.geo"}).input == "ä.geo");
}

TEST_CASE("request: --help and --version need nothing else") {
  CHECK(parse({"--help"}).help);
  CHECK(parse({"-help"}).help);
  CHECK(parse({"-h"}).help);
  CHECK(parse({"--version"}).version);
}

TEST_CASE("request: arguments that make no sense are named") {
  const struct {
    Words words;
    const char* message;
  } kCases[] = {
      {{}, "which file?"},
      {{"a.geo", "-frobnicate"}, "unknown option '-frobnicate'"},
      {{"a.geo", "--frobnicate=3"}, "unknown option '--frobnicate'"},
      {{"a.geo", "-4"}, "unknown option '-4'"},
      {{"a.geo", "-1"}, "-1: not here; quads need surfaces"},
      {{"a.geo", "-clmax"}, "'-clmax' needs 1 value"},
      {{"a.geo", "-setnumber", "x"}, "'-setnumber' needs 2 values"},
      {{"a.geo", "-clmax", "abc"}, "-clmax: 'abc' is not a positive number"},
      {{"a.geo", "-clmin", "-1"}, "-clmin: '-1' is not a positive number"},
      {{"a.geo", "-clscale", "0"}, "-clscale: '0' is not a positive number"},
      {{"a.geo", "-clmax", "nan"}, "is not a positive number"},
      {{"a.geo", "-clmax", "0.1mm"}, "is not a positive number"},
      {{"a.geo", "-setnumber", "x", "y"}, "-setnumber: 'y' is not a number"},
      {{"a.geo", "-setnumber", "Mesh.MshFileVersion", "7"}, "there is no version '7'"},
      {{"a.geo", "-algo", "magic"}, "-algo: 'magic' is not an algorithm"},
      {{"a.geo", "-v", "loud"}, "-v"},
      {{"a.geo", "-nt", "-1"}, "-nt"},
      {{"a.geo", "-o", "b.msh", "-o", "c.msh"}, "-o is given twice"},
      {{"a.geo", "-format", "msh", "-f", "vtk"}, "-format is given twice"},
      {{"a.geo", "--layers", "some"}, "--layers is on or off, not 'some'"},
      {{"a.geo", "--crease", "200"}, "--crease takes a number, from 0 to 180, not '200'"},
      {{"a.geo", "--crease", "nan"}, "--crease takes a number, from 0 to 180, not 'nan'"},
      {{"a.msh", "--check", "--min-sj", "0.3x"}, "--min-sj takes a number, from -1 to 1, not '0.3x'"},
      {{"a.msh", "--against", "b", "--max-distance", "-1"}, "--max-distance takes a number, 0 or more, not '-1'"},
      {{"a.geo", "--surfaces", "3,,7"}, "--surfaces: '' is not a tag"},
      {{"a.geo", "--keep-curves", "3,x"}, "--keep-curves: 'x' is not a tag; give the numbers of curves"},
      {{"a.geo", "--surfaces", "steel"}, "--surfaces: 'steel' is not a tag; give the numbers of surfaces"},
  };
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.words);
    std::string message;
    try {
      parse(the_case.words);
    } catch (const UsageError& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find(the_case.message) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("request: an empty value is refused and does not take the next word") {
  const struct {
    Words words;
    const char* message;
  } kCases[] = {
      {{"-o", "", "a.geo"}, "-o needs a value"},
      {{"--o=", "a.geo"}, "-o needs a value"},
      {{"-format", "", "a.geo"}, "-format needs a value"},
      {{"--stats", "", "a.geo"}, "--stats needs a value"},
      {{"--surfaces", "", "a.geo"}, "--surfaces needs a value"},
      // The next option is no value: the file behind it would be merged, and the input written over.
      {{"a.geo", "--stats", "-o", "b.msh"}, "'--stats' needs a value before '-o'"},
      {{"a.geo", "-o", "--stats", "s.json"}, "'-o' needs a value before '--stats'"},
      {{"a.geo", "-string", "-o", "b.msh"}, "'-string' needs a value before '-o'"},
      {{"a.geo", "-bgm", "-o", "b.msh"}, "'-bgm' needs a value before '-o'"},
  };
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.words);
    CHECK_THROWS_WITH_AS(parse(the_case.words), the_case.message, UsageError);
  }
  CHECK(parse({"-setstring", "name", "", "a.geo"}).input == "a.geo");
}

TEST_CASE("request: messages spell the options as the help does") {
  for (const Words& words : {Words{"a.geo", "-v", "loud"}, Words{"a.geo", "-nt", "-1"}}) {
    std::string message;
    try {
      parse(words);
    } catch (const UsageError& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find(words[1]) != std::string::npos);
    CHECK(message.find("--") == std::string::npos);
  }
}

TEST_CASE("request: the help names every option and every exit status") {
  const std::string help = qmorph::cli::help_text();
  for (const char* word :
       {"-o FILE", "-format", "-bin",    "-clmin",  "-clmax",     "-clscale", "-setnumber", "-setstring",
        "-algo",   "-v N",    "-2",      "-nt",     "--surfaces", "--stats",  "--help",     "--version",
        "\n  0  ", "\n  1  ", "\n  2  ", "\n  3  ", "\n  4  ",    "\n  5  "})
    CHECK(help.find(word) != std::string::npos);
}

TEST_CASE("request: counts must be whole numbers") {
  for (const std::string option : {"-nt", "-part", "-v"})
    for (const char* value : {"-3", "abc", "2.5", "99999999999"}) {
      CAPTURE(value);
      const std::string message = option + " takes a whole number, 0 or more";
      CHECK_THROWS_WITH_AS(parse({"in.msh", option, value}), message.c_str(), UsageError);
    }
  CHECK(parse({"in.msh", "-nt", "0"}).threads == 0);
}

TEST_CASE("request: numbers are read to their end, in any usual spelling") {
  CHECK(parse({"a.msh", "--check", "--min-sj", "+.5"}).thresholds.min_scaled_jacobian == 0.5);
  CHECK(parse({"a.msh", "--check", "--min-sj", "-5e-1"}).thresholds.min_scaled_jacobian == -0.5);
  CHECK(parse({"a.geo", "-nt", "+04"}).threads == 4);
  CHECK_THROWS_AS(parse({"a.geo", "-nt", "+-4"}), UsageError);
  CHECK_THROWS_AS(parse({"a.geo", "-nt", " 4"}), UsageError);
}

TEST_CASE("request: flags may be repeated, lists grow") {
  CHECK(parse({"a.geo", "-bin", "-bin", "-2", "-2"}).binary == true);
  CHECK(parse({"a.geo", "--all-quad", "--keep-curves", "3,4", "--keep-curves", "7"}).keep_curves ==
        std::vector<int>{3, 4, 7});
}

TEST_CASE("request: the window needs no file, and leaves what is to be done to its panel") {
  CHECK(parse({"--gui"}).gui);
  CHECK(parse({"--gui"}).input.empty());
  const Request request = parse({"in.geo", "--gui", "--crease", "30", "-clmax", "0.1", "-o", "out.msh"});
  CHECK(request.input == "in.geo");
  CHECK(request.crease == 30);
  CHECK(!request.view);
  for (const Words& words : {Words{"--gui", "--check", "in.msh"}, Words{"--gui", "in.geo", "--view"},
                             Words{"--gui", "in.geo", "--report", "a.html"}, Words{"--gui", "-"},
                             Words{"--gui", "in.geo", "-o", "-"}, Words{"--gui", "in.geo", "--for", "mfem"}})
    CHECK_THROWS_AS(parse(words), UsageError);
}
