// SPDX-License-Identifier: GPL-2.0-or-later
/// The program itself, as a Makefile calls it.

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

constexpr const char* kSquare =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.3;\n";

constexpr const char* kFineSquare =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.03;\n";

/// Exit status of the program with these words, its output in files of the directory.
int call(const TemporaryDirectory& directory, const std::string& words) {
  const std::string command =
      fmt::format("'{}' {} >'{}' 2>'{}'", QMORPH_COMMAND, words, directory / "stdout", directory / "stderr");
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A file system of a few pages, if we may have one.
class TinyDisk {
 public:
  explicit TinyDisk(const std::string& path) : path_(path) {
    ::mkdir(path.c_str(), 0755);
    mounted_ = ::mount("tmpfs", path.c_str(), "tmpfs", 0, "size=16k") == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount(path_.c_str());
  }
  bool mounted() const { return mounted_; }

 private:
  std::string path_;
  bool mounted_ = false;
};

}  // namespace

TEST_CASE("process: what OpenCASCADE prints does not go to stdout") {
  const TemporaryDirectory directory;
  write_file(directory / "in.step", "ISO-10303-21;\nQUID;\n");
  CHECK(call(directory, fmt::format("'{}' -o '{}'", directory / "in.step", directory / "out.msh")) == 2);
  CHECK(read_file(directory / "stdout").empty());
  CHECK(!read_file(directory / "stderr").empty());
}

TEST_CASE("process: exit statuses") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const std::string in = directory / "in.geo", out = directory / "out.msh";
  CHECK(call(directory, fmt::format("'{}' -2 -o '{}'", in, out)) == 0);
  CHECK(read_file(directory / "stdout").empty());
  CHECK(call(directory, fmt::format("'{}' -foo", in)) == 1);
  CHECK(call(directory, "/none.geo") == 2);
  CHECK(call(directory, fmt::format("'{}'", out)) == 0);
  write_file(directory / "point.geo", "Point(1) = {0, 0, 0, 1};\n");
  CHECK(call(directory, fmt::format("'{}'", directory / "point.geo")) == 4);
  CHECK(call(directory, fmt::format("'{}' -o /no/such/directory/x.msh", in)) == 5);
  CHECK(call(directory, "--help") == 0);
  CHECK(call(directory, "") == 1);
}

TEST_CASE("process: where files may not grow, nothing is left behind") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kFineSquare);
  const std::string out = directory / "out.msh";
  write_file(out, "earlier");
  const std::string command =
      fmt::format("ulimit -f 2; '{}' '{}' -o '{}' 2>/dev/null", QMORPH_COMMAND, directory / "in.geo", out);
  const int status = std::system(command.c_str());
  CHECK(WEXITSTATUS(status) == 5);
  CHECK(directory.files() == std::vector<std::string>{"in.geo", "out.msh"});
  CHECK(read_file(out) == "earlier");
}

TEST_CASE("process: no directory for temporary files") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  const std::string command =
      fmt::format("TMPDIR=/no/such '{}' '{}' 2>'{}'", QMORPH_COMMAND, directory / "in.geo", directory / "stderr");
  const int status = std::system(command.c_str());
  CHECK(WEXITSTATUS(status) == 2);
  CHECK(read_file(directory / "stderr").find("set TMPDIR") != std::string::npos);
}

TEST_CASE("process: figures that cannot be written leave the earlier mesh") {
  const TemporaryDirectory directory;
  const TinyDisk disk(directory / "disk");
  if (!disk.mounted()) return;
  write_file(directory / "disk/filler", std::string(15000, 'x'));
  write_file(directory / "in.geo", kSquare);
  const std::string out = directory / "out.msh";
  write_file(out, "earlier");
  CHECK(call(directory,
             fmt::format("'{}' -o '{}' --stats '{}'", directory / "in.geo", out, directory / "disk/s.json")) == 5);
  CHECK(read_file(out) == "earlier");
}

TEST_CASE("process: a script that calls Exit is a failure") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", std::string(kSquare) + "Exit;\n");
  CHECK(call(directory, fmt::format("'{}'", directory / "in.geo")) == 2);
  CHECK(read_file(directory / "stderr").find("Gmsh ended the program") != std::string::npos);
  CHECK(directory.files() == std::vector<std::string>{"in.geo", "stderr", "stdout"});
}

TEST_CASE("process: options that Gmsh rejects are a failure, and leave nothing in the user's directory") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n");
  write_file(directory / "bad.opt", "garbage ((\n");
  write_file(directory / "new.opt", "Mesh.Tomorrow = 1;\nMesh.MeshSizeMax = 0.1;\n");
  std::filesystem::create_directory(directory / "home");
  const auto run = [&](const std::string& words) {
    const std::string out = directory / "out.msh";
    std::filesystem::remove(out);
    const int status = std::system(
        fmt::format("cd '{}' && HOME=home '{}' in.geo -o out.msh {} 2>stderr", directory / ".", QMORPH_COMMAND, words)
            .c_str());
    CHECK(std::filesystem::exists(out) == (status == 0));
    CHECK(std::filesystem::is_empty(directory / "home"));
    return std::pair(WEXITSTATUS(status), read_file(directory / "stderr"));
  };
  CHECK(run("-option none.opt") == std::pair(2, std::string("qmorph: none.opt: no such file\n")));
  const std::string refused = "qmorph: the options cannot be understood: ";
  for (const auto& [words, source] :
       std::map<std::string, std::string>{{"-option bad.opt", "'bad.opt'"}, {"-string 'garbage (('", "'-string'"}}) {
    const auto result = run(words);
    CAPTURE(result.second);
    CHECK(result.first == 2);
    CHECK(result.second.rfind(refused + source, 0) == 0);
  }
  const auto [status, said] = run("-option new.opt");
  CHECK(status == 0);
  CHECK(said.find("warning: Unknown number option 'Mesh.Tomorrow'") != std::string::npos);
  CHECK(run("-string 'Mesh.MeshSizeMax = 0.2;'").first == 0);
}

TEST_CASE("process: a full disk is reported, and the earlier file is as it was") {
  const TemporaryDirectory directory;
  const TinyDisk disk(directory / "disk");
  if (!disk.mounted()) {
    MESSAGE("skipped: only root may make a full disk");
    return;
  }
  const std::string in = directory / "in.geo", out = directory / "disk/out.msh", again = directory / "again.msh";
  write_file(in, kFineSquare);
  write_file(out, "earlier");
  // MSH 2.2 that stays MSH 2.2 is written by ourselves.
  make_msh(again, 2.2, false, [] {
    build_two_squares();
    ::gmsh::model::mesh::refine();
    ::gmsh::model::mesh::refine();
  });
  for (const std::string& input : {in, again})
    for (const char* options :
         {"-format msh", "-format msh -bin", "-format msh2", "-format msh2 -bin", "-format vtk", "-format inp"}) {
      CAPTURE(input);
      CAPTURE(options);
      CHECK(call(directory, fmt::format("'{}' {} -o '{}'", input, options, out)) == 5);
      CHECK(read_file(directory / "stderr").find("cannot write") != std::string::npos);
      CHECK((read_file(out) == "earlier"));
      CHECK(std::distance(std::filesystem::directory_iterator(directory / "disk"), {}) == 1);
    }
}

TEST_CASE("process: an answer that cannot be written to standard output is a failure, with one line") {
  const TemporaryDirectory directory;
  write_file(directory / "in.geo", kSquare);
  make_msh(directory / "in.msh", 4.1, false, build_two_squares);
  for (const std::string& words :
       {fmt::format("'{}' -o - -v 0", directory / "in.msh"), fmt::format("'{}' -o - -v 0", directory / "in.geo"),
        fmt::format("--check '{}'", directory / "in.msh"), std::string("--help")})
    for (const char* nowhere : {">/dev/full", ">&-"}) {
      CAPTURE(words);
      CAPTURE(nowhere);
      const std::string command =
          fmt::format("'{}' {} {} 2>'{}'", QMORPH_COMMAND, words, nowhere, directory / "stderr");
      CHECK(WEXITSTATUS(std::system(command.c_str())) == 5);
      const std::string said = read_file(directory / "stderr");
      CHECK(said.find("qmorph: cannot write the standard output: ") == 0);
      CHECK(said.find('\n') == said.size() - 1);
    }
}

TEST_CASE("process: if the reader of a pipe goes away, no temporary file is left, and no message names one") {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "tmp");
  write_file(directory / "in.geo", kFineSquare);
  const std::string stats = directory / "s.json", said = directory / "stderr";
  const std::string command =
      fmt::format("(TMPDIR='{}' '{}' - --stats '{}' <'{}' 2>'{}'; echo $? >'{}') | true", directory / "tmp",
                  QMORPH_COMMAND, stats, directory / "in.geo", said, directory / "status");
  CHECK(std::system(command.c_str()) == 0);
  CHECK(read_file(directory / "status") == "5\n");
  CHECK(std::filesystem::is_empty(directory / "tmp"));
  CHECK(read_file(said).find(directory / "tmp") == std::string::npos);
  CHECK(read_file(said).find("s; standard output\n") != std::string::npos);
  const auto figures = nlohmann::json::parse(read_file(stats));
  CHECK(figures["output"] == "-");
  CHECK(figures["input"] == "-");
}
