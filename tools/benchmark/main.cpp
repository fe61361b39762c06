// SPDX-License-Identifier: GPL-2.0-or-later
// qmorph_bench: what a conversion costs, alone and compared with Gmsh. Run it by tools/bench.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "beside_gmsh.hpp"
#include "engine_alone.hpp"
#include "hard_table.hpp"
#include "triangulations.hpp"

namespace {

using benchmark::Kind;

const char* const kUsage =
    "usage: bench [--even] [--graded] [--many] [--once] [TRIANGLES...]\n"
    "       bench --beside-gmsh [--even] [--graded] [--many] [--limit SECONDS] [--svg FILE] [TRIANGLES...]\n"
    "       bench --hard [--limit SECONDS] [TRIANGLES...] [WORD]\n"
    "       bench --write FILE.msh [--graded | --many] [TRIANGLES]\n"
    "  Converts triangulations of about so many triangles (10000 100000 1000000): of even size, of graded size, and of "
    "many\n"
    "  surfaces (100); all three if none is named.\n"
    "  --once: one conversion each instead of the middle one of three\n"
    "  --beside-gmsh: the same triangles by Gmsh's recombination and by qmorph, as tables\n"
    "  --hard: inputs that are hard to convert in time, those with WORD in their names; fails above 30 microseconds a "
    "triangle.\n"
    "  Of 3 000 to 100 000 triangles, or about so many\n"
    "  --limit SECONDS: of the processor, for each measurement (600)\n"
    "  --svg FILE: the tables as a picture\n"
    "  --write FILE.msh: no conversion; the triangles as a file, for other programs\n";

struct Request {
  std::vector<double> sizes;
  std::vector<Kind> kinds;
  std::string write, svg, word;
  int repeats = 3;
  bool beside_gmsh = false, hard = false;
  double limit = 600;
};

/// \return false if the arguments make no sense
bool parse(const std::vector<std::string>& words, Request& request) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool has_value = i + 1 < words.size();
    if (word == "--even")
      request.kinds.push_back(Kind::even);
    else if (word == "--graded")
      request.kinds.push_back(Kind::graded);
    else if (word == "--many")
      request.kinds.push_back(Kind::many);
    else if (word == "--once")
      request.repeats = 1;
    else if (word == "--beside-gmsh")
      request.beside_gmsh = true;
    else if (word == "--hard")
      request.hard = true;
    else if (word == "--limit" && has_value && std::atof(words[i + 1].c_str()) > 0)
      request.limit = std::atof(words[++i].c_str());
    else if (word == "--svg" && has_value)
      request.svg = words[++i];
    else if (word == "--write" && has_value)
      request.write = words[++i];
    else if (const double size = std::atof(word.c_str()); size >= 100)
      request.sizes.push_back(size);
    else if (request.hard && !word.starts_with("-"))
      request.word = word;
    else
      return false;
  }
  return true;
}

bool time_hard_inputs(const Request& request) {
  if (request.sizes.empty()) return benchmark::time_hard_inputs(request.word, {}, request.limit);
  bool all_quick = true;
  for (double size : request.sizes)
    all_quick = benchmark::time_hard_inputs(request.word, size, request.limit) && all_quick;
  return all_quick;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> words(argv + 1, argv + argc);
  Request request;
  if (words == std::vector<std::string>{"--help"}) return std::fputs(kUsage, stdout), 0;
  if (!parse(words, request)) return std::fputs(kUsage, stderr), 1;
  if (request.hard) return time_hard_inputs(request) ? 0 : 3;
  if (request.sizes.empty()) request.sizes = {1e4, 1e5, 1e6};
  if (!request.write.empty()) {
    const Kind kind = request.kinds.empty() ? Kind::even : request.kinds[0];
    benchmark::write_msh2(benchmark::make_triangulation(request.sizes[0], kind), request.write);
    return 0;
  }
  if (request.kinds.empty()) request.kinds.assign(std::begin(benchmark::kKinds), std::end(benchmark::kKinds));
  if (!request.beside_gmsh) return benchmark::time_engine(request.sizes, request.kinds, request.repeats) ? 0 : 3;
  const auto comparisons = benchmark::compare_with_gmsh(request.sizes, request.kinds, request.limit);
  if (!request.svg.empty()) benchmark::write_plot(comparisons, request.svg);
  for (const auto& c : comparisons)
    if (c.one_thread.end == benchmark::End::failed || c.two_threads.end == benchmark::End::failed) return 3;
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench: %s\n", error.what());
  return 3;
}
