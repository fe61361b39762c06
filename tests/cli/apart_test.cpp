// SPDX-License-Identifier: GPL-2.0-or-later
/// Whatever ends the program, it leaves nothing behind, and a message says why.

#include "cli/apart.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "gmsh/support.hpp"
#include "gmsh/write/staged_file.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string kSquare = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nMesh.MeshSizeMax = 0.1;\n";

/// A directory with one for temporary files, both of which have to be clean in the end.
struct Place {
  TemporaryDirectory directory;
  Place() { std::filesystem::create_directory(directory / "tmp"); }

  /// \return as system() does. What it says is in `said`.
  int shell(const std::string& command) {
    const int status = std::system(
        fmt::format("export TMPDIR='{}'; ulimit -c unlimited; cd '{}'; qmorph='{}'; {{ {} ; }} >stdout 2>stderr",
                    directory / "tmp", directory / ".", QMORPH_COMMAND, command)
            .c_str());
    said = read_file(directory / "stderr");
    return status;
  }
  int status_of(const std::string& words) { return WEXITSTATUS(shell("\"$qmorph\" " + words)); }
  /// Names of what is there, but for the streams.
  std::vector<std::string> files() const {
    std::vector<std::string> names = directory.files();
    for (const auto& entry : std::filesystem::directory_iterator(directory / "tmp"))
      names.push_back("tmp/" + entry.path().filename().string());
    std::erase_if(names, [](const std::string& name) { return name == "tmp" || name.rfind("std", 0) == 0; });
    return names;
  }

  std::string said;
};

/// Starts the program, and ends it by a signal after a while. \return as waitpid() does
int end_after(const Place& place, int signal, std::chrono::microseconds delay) {
  ::sigset_t one, before;  // the signal waits until the child no longer has the handler of the tests
  ::sigemptyset(&one), ::sigaddset(&one, signal);
  ::sigprocmask(SIG_BLOCK, &one, &before);
  const ::pid_t child = ::fork();
  if (child == 0) ::signal(signal, SIG_DFL);
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  if (child == 0) {
    const std::string in = place.directory / "in.geo", out = place.directory / "out.msh";
    ::setenv("TMPDIR", (place.directory / "tmp").c_str(), 1);
    ::execl(QMORPH_COMMAND, "qmorph", in.c_str(), "-v", "0", "-o", out.c_str(), nullptr);
    ::_exit(99);
  }
  std::this_thread::sleep_for(delay);
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("apart: a crash of Gmsh is status 2 and one line, wherever it is") {
  Place place;
  const std::string crash = "SystemCall \"kill -SEGV $PPID\";\n";  // of the process that reads the script
  write_file(place.directory / "in.geo", kSquare + crash);
  for (const std::string words : {"in.geo -o out.msh", "--check in.geo", "- -o out.msh <in.geo"}) {
    CAPTURE(words);
    CHECK(place.status_of(words) == 2);
    CHECK(mentions(place.said, "qmorph: "));
    CHECK(mentions(place.said, " cannot be read: Gmsh crashed (Segmentation fault)\n"));
    CHECK(std::count(place.said.begin(), place.said.end(), '\n') == 1);
    CHECK(place.files() == std::vector<std::string>{"in.geo"});
  }
  write_file(place.directory / "in.geo", kSquare + "SystemCall \"kill -KILL $PPID\";\n");
  CHECK(place.status_of("in.geo") == 2);
  CHECK(mentions(place.said, "(killed; is there not enough memory?)\n"));
  write_file(place.directory / "in.geo",
             kSquare + "SystemCall \"echo '  what():  std::bad_alloc' >&2; kill -ABRT $PPID\";\n");
  CHECK(place.status_of("in.geo") == 2);
  CHECK(mentions(place.said, "Gmsh crashed (there is not enough memory)\n"));
}

TEST_CASE("apart: where there is no display, --gui is status 1 and one line") {
  Place place;
  write_file(place.directory / "in.geo", kSquare);
  for (const std::string where : {"unset DISPLAY WAYLAND_DISPLAY", "unset WAYLAND_DISPLAY; export DISPLAY=:9999"}) {
    CAPTURE(where);
    CHECK(WEXITSTATUS(place.shell(where + "; \"$qmorph\" --gui in.geo")) == 1);
    CHECK(place.said.rfind("qmorph: --gui: ", 0) == 0);
    CHECK(std::count(place.said.begin(), place.said.end(), '\n') == 1);
    CHECK(place.files() == std::vector<std::string>{"in.geo"});
  }
}
TEST_CASE("apart: no signal that ends the program leaves a file") {
  Place place;
  write_file(place.directory / "in.geo", kSquare + "Mesh.MeshSizeMax = 0.02;\n");
  int ended = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    for (int step = 0; step < 6; ++step) {
      CAPTURE(signal);
      CAPTURE(step);
      const int status = end_after(place, signal, std::chrono::milliseconds(10 + 60 * step));
      if (WIFSIGNALED(status)) {
        CHECK(WTERMSIG(status) == signal);
        ++ended;
      } else {
        CHECK(WEXITSTATUS(status) == 0);
      }
      std::vector<std::string> names = place.files();
      std::erase(names, "out.msh");
      CHECK(names == std::vector<std::string>{"in.geo"});
      std::filesystem::remove(place.directory / "out.msh");
    }
  CHECK(ended > 0);
}

TEST_CASE("apart: one process ends with the other, whatever it is doing") {
  Place place;
  write_file(place.directory / "in.geo", kSquare + "SystemCall \"kill -TERM $PPID\";\n");
  const int ended = place.shell("exec \"$qmorph\" in.geo");
  CHECK(WIFSIGNALED(ended));
  CHECK(WTERMSIG(ended) == SIGTERM);
  CHECK(place.files() == std::vector<std::string>{"in.geo"});
  // A command of a script has the signals of the terminal for itself.
  write_file(place.directory / "in.geo", kSquare + "SystemCall \"exec sleep 5\";\n");
  CHECK(WIFSIGNALED(end_after(place, SIGINT, std::chrono::milliseconds(500))));
  CHECK(place.files() == std::vector<std::string>{"in.geo"});
}

TEST_CASE("apart: a signal that is to be ignored is ignored") {
  Place place;
  write_file(place.directory / "in.geo", kSquare + "SystemCall \"sleep 0.3\";\n");
  CHECK(WEXITSTATUS(place.shell("trap '' HUP; \"$qmorph\" in.geo -v 0 & sleep 0.1; kill -HUP $!; wait $!")) == 0);
  CHECK(place.files() == std::vector<std::string>{"in.geo", "in.msh"});
}

TEST_CASE("apart: temporary names are unique, and file names may be as long as the system allows") {
  Place place;
  const std::string target = place.directory / "out.msh";
  adapter::TemporaryNames names;
  {
    const adapter::StagedFile one(target, ".msh", &names), other(target, ".msh");
    CHECK(one.path() != other.path());
    CHECK(place.files().size() == 2);
    names.remove_files();
    CHECK(place.files().size() == 1);
  }
  CHECK(place.files().empty());
  std::string longest(255, 'x');
  longest.replace(251, 4, ".msh");
  write_file(place.directory / "in.geo", kSquare);
  CHECK(place.status_of(fmt::format("in.geo -o {} --stats {}", longest, std::string(255, 'y'))) == 0);
  CHECK(place.files() == std::vector<std::string>{"in.geo", longest, std::string(255, 'y')});
  CHECK(place.status_of(fmt::format("in.geo -o x{}", longest)) == 5);
  CHECK(mentions(place.said, "File name too long\n"));
}

TEST_CASE("apart: output of libraries is dropped where the run fails, and shown where it does not") {
  Place place;
  write_file(place.directory / "in.step", "ISO-10303-21;\nQUID;\n");
  CHECK(place.status_of("in.step") == 2);
  CHECK(std::count(place.said.begin(), place.said.end(), '\n') == 1);
  write_file(place.directory / "in.geo", kSquare + "SystemCall \"echo out; echo err >&2\";\n");
  CHECK(place.status_of("in.geo") == 0);
  CHECK(mentions(place.said, "out\nerr\n"));
  CHECK(read_file(place.directory / "stdout").empty());
  CHECK(place.status_of("in.geo -v 1") == 0);
  CHECK(!mentions(place.said, "out\nerr\n"));
}

TEST_CASE("apart: input that does not end is refused") {
  Place place;
  ::mkfifo((place.directory / "pipe.msh").c_str(), 0600);
  for (const std::string input : {"/dev/zero", "pipe.msh"}) {
    CAPTURE(input);
    CHECK(place.status_of(input + " -o out.msh") == 2);
    CHECK(mentions(place.said, "is not a regular file"));
  }
  CHECK(place.status_of("- -o out.msh </dev/zero") == 2);
  CHECK(mentions(place.said, "standard input is neither a mesh"));
  CHECK(place.status_of("- -o out.msh </dev/null") == 2);
  CHECK(mentions(place.said, "standard input is empty"));
  CHECK(WEXITSTATUS(place.shell("yes | \"$qmorph\" - -o out.msh")) == 2);
  CHECK(mentions(place.said, "standard input does not end"));
  CHECK(std::count(place.said.begin(), place.said.end(), '\n') == 1);
  CHECK(place.files() == std::vector<std::string>{"pipe.msh"});
}

TEST_CASE("apart: messages call standard input and output by these names") {
  Place place;
  for (const std::string text : {"Point(1) = {0;\n", "$MeshFormat\n9.9 0 8\n$EndMeshFormat\n", "ISO-10303-21;\nQUID;\n",
                                 "Point(1) = {0, 0, 0};\n"}) {
    CAPTURE(text);
    write_file(place.directory / "in", text);
    CHECK(place.status_of("- <in") > 0);
    CAPTURE(place.said);
    CHECK(mentions(place.said, "standard input"));
    CHECK(!mentions(place.said, place.directory / "tmp"));
  }
}
