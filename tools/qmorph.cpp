#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "cli/run.hpp"

namespace {

bool running = false;

/// A script with `Exit;` makes Gmsh end the process from within, with status 0 and without a file.
void say_that_gmsh_ended_it() {
  if (!running) return;
  std::cerr << "qmorph: Gmsh ended the program (does the script say Exit?); nothing has been written\n";
  ::_exit(qmorph::cli::bad_input);
}

}  // namespace

int main(int argc, char** argv) {
  std::atexit(say_that_gmsh_ended_it);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that is not allowed to grow becomes an error, which cleans up
  running = true;
  const int status = qmorph::cli::run({argv + 1, argv + argc}, std::cout, std::cerr);
  running = false;
  return status;
}
