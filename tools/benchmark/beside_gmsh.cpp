// SPDX-License-Identifier: GPL-2.0-or-later
#include "beside_gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "gmsh_tasks.hpp"

namespace benchmark {
namespace {

constexpr double kLargestToMesh = 2e6;  // triangles: Gmsh's mesher needs minutes for a million
constexpr double kRepeatBelow = 2;      // seconds
constexpr int kRepeats = 3;

/// A folder for files that processes exchange; removed at the end of its life.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "qmorph-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// The fastest of a few, if they are short: other programs on the machine only ever add to the time.
Ran fastest(const std::function<Figures()>& task, double limit) {
  Ran best = run_apart(task, limit);
  for (int i = 1; i < kRepeats && best.end == End::finished && best.figures.work < kRepeatBelow; ++i)
    if (const Ran again = run_apart(task, limit); again.end == End::finished && again.figures.work < best.figures.work)
      best = again;
  return best;
}

bool same_bytes(const std::string& a, const std::string& b) {
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return first && second && std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

Comparison compare(double size, Kind kind, double limit, const Folder& folder, bool try_blossom) {
  const std::string in = folder.file("triangles.msh"), quads = folder.file("quads.msh");
  const std::string meshed = folder.file("meshed.msh");
  const std::string one = folder.file("one.msh"), two = folder.file("two.msh");
  for (const std::string& file : {in, meshed, quads, one, two})
    std::filesystem::remove(file);  // those of the previous size
  Comparison result;
  result.kind = kind;
  const Ran made = run_apart(
      [&] {
        const Triangulation mesh = make_triangulation(size, kind);
        Figures figures = write_triangles(mesh, in);
        figures.triangles = mesh.triangle_count();
        return figures;
      },
      limit);
  if (made.end != End::finished) throw std::runtime_error("the triangles could not be made");
  result.triangles = made.figures.triangles;
  if (kind == Kind::even && size <= kLargestToMesh) {
    result.meshing = run_apart([&] { return gmsh_meshes(size, meshed); }, limit);
    result.converted = fastest([&] { return qmorph_recombines(meshed, quads, 1); }, limit);
  }
  result.simple = fastest([&] { return gmsh_recombines(in, quads, 0); }, limit);
  if (try_blossom) result.blossom = fastest([&] { return gmsh_recombines(in, quads, 1); }, limit);
  result.one_thread = fastest([&] { return qmorph_recombines(in, one, 1); }, limit);
  result.two_threads = fastest([&] { return qmorph_recombines(in, two, 2); }, limit);
  result.same_bytes = same_bytes(one, two);
  return result;
}

/// "1.23 s, 4.56 µs, 78 MB"
std::string cell(const Comparison& c, Ran Comparison::*which, double limit) {
  const Ran& ran = c.*which;
  if (ran.end == End::over_limit) return fmt::format("more than {:.0f} s", limit);
  if (ran.end == End::not_tried) return "-";
  if (ran.end == End::failed) return "failed";
  const double time = seconds(c, which);
  return fmt::format("{:.{}f} s, {:.2f} µs, {:.0f} MB", time, time < 10 ? 2 : 1, 1e6 * time / double(c.triangles),
                     1e-6 * ran.peak_bytes);
}

constexpr const char* kRivals =
    R"(From triangles to quads in Gmsh's model: CPU seconds (elapsed ones for 2 threads), microseconds per triangle, and
peak memory of the process (-: not tried, since it would take more than {:.0f} s even at the previous size's cost per
triangle):

| surfaces | triangles | Gmsh, simple | Gmsh, Blossom | qmorph, 1 thread | qmorph, 2 threads |
|---|---|---|---|---|---|
)";

void print_rivals(const std::vector<Comparison>& comparisons, double limit) {
  fmt::print(kRivals, limit);
  for (const Comparison& c : comparisons) {
    fmt::print("| {} | {} |", name_of(c.kind), c.triangles);
    for (const auto which :
         {&Comparison::simple, &Comparison::blossom, &Comparison::one_thread, &Comparison::two_threads})
      fmt::print(" {} |", cell(c, which, limit));
    fmt::print("\n");
  }
}

/// CPU seconds of the conversion alone: front to rest.
double conversion_seconds(const Figures& f) { return f.cpu / f.work * f.convert; }

void print_meshing(const std::vector<Comparison>& comparisons) {
  const char* heading =
      "\nTriangles that Gmsh itself makes (algorithm 6) in such a square with holes, and their conversion by one "
      "thread:\n\n"
      "| triangles | Gmsh makes them | qmorph converts them | share |\n|---|---|---|---|\n";
  for (const Comparison& c : comparisons) {
    if (c.meshing.end != End::finished || c.converted.end != End::finished) continue;
    const double made = c.meshing.figures.cpu, converted = conversion_seconds(c.converted.figures);
    fmt::print("{}| {} | {:.2f} s | {:.3f} s | {:.3f} |\n", std::exchange(heading, ""), c.meshing.figures.triangles,
               made, converted, converted / made);
  }
}

constexpr const char* kStages = R"(
qmorph's CPU seconds by stages, on one thread, between Gmsh's own for opening and writing the files (MSH 4.1, binary). I/O:
Gmsh's share of the total; speed-up: of the conversion alone (front to rest), elapsed seconds on one thread and on two; same:
both wrote the same bytes:

| surfaces | triangles | open | read | front | cleanup | smoothing | rest | check | replace | write | I/O | conversion | speed-up | same |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
)";

void print_stages(const std::vector<Comparison>& comparisons) {
  fmt::print("{}", kStages);
  for (const Comparison& c : comparisons) {
    if (c.one_thread.end != End::finished) continue;
    const Figures& f = c.one_thread.figures;
    const double own = f.cpu / f.work;  // share of the elapsed time for which the processor was ours
    const double rest = std::max(0.0, f.convert - f.front - f.cleanup - f.smoothing);
    std::string row = fmt::format("| {} | {} | {:.2f} |", name_of(c.kind), c.triangles, f.open);
    for (const double time : {f.read, f.front, f.cleanup, f.smoothing, rest, f.check, f.replace})
      row += fmt::format(" {:.2f} |", own * time);
    row += fmt::format(" {:.2f} | {:.0f} % | {:.2f} |", f.write, 100 * (f.open + f.write) / (f.open + f.cpu + f.write),
                       conversion_seconds(f));
    if (c.two_threads.end == End::finished)
      row += fmt::format(" {:.2f} → {:.2f}: {:.2f} | {} |", f.convert, c.two_threads.figures.convert,
                         f.convert / c.two_threads.figures.convert, c.same_bytes ? "yes" : "**no**");
    else
      row += " - | - |";
    fmt::print("{}\n", row);
  }
}

/// False if Gmsh's Blossom would exceed the limit even at the previous size's cost per triangle.
bool worth_trying(const Comparison& before, double size, double limit) {
  if (before.blossom.end != End::finished) return false;
  return before.blossom.figures.cpu / double(before.triangles) * size < limit;
}

/// On a quiet machine, the CPU time of one thread is its elapsed time.
void print_disturbance(const std::vector<Comparison>& comparisons) {
  constexpr double kQuiet = 0.9, kShort = 0.1;  // share; seconds
  double work = 0, cpu = 0;
  for (const Comparison& c : comparisons)
    for (const Ran* ran : {&c.simple, &c.blossom, &c.one_thread})
      if (ran->end == End::finished && ran->figures.work > kShort) work += ran->figures.work, cpu += ran->figures.cpu;
  if (cpu < kQuiet * work)
    fmt::print(
        "\nOther programs ran meanwhile: one thread had a processor for {:.0f} % of the time, and two threads had less "
        "than "
        "two, so that the speed-ups say nothing.\n",
        100 * cpu / work);
}

void log(const Comparison& c) {
  const Figures &one = c.one_thread.figures, &two = c.two_threads.figures;
  fmt::print(stderr,
             "bench: {}, {} triangles: 1 thread {:.2f} s of the processor in {:.2f} s; 2 threads {:.2f} in {:.2f}\n",
             name_of(c.kind), c.triangles, one.cpu, one.work, two.cpu, two.work);
}

}  // namespace

double seconds(const Comparison& comparison, Ran Comparison::*which) {
  const Figures& figures = (comparison.*which).figures;
  return which == &Comparison::two_threads ? figures.work : figures.cpu;
}

std::vector<Comparison> compare_with_gmsh(const std::vector<double>& sizes, const std::vector<Kind>& kinds,
                                          double limit) {
  const Folder folder;
  std::vector<Comparison> comparisons;
  for (const Kind kind : kinds) {
    for (const double size : sizes) {
      const bool first = comparisons.empty() || comparisons.back().kind != kind;
      const bool try_blossom = first || worth_trying(comparisons.back(), size, limit);
      comparisons.push_back(compare(size, kind, limit, folder, try_blossom));
      log(comparisons.back());
    }
  }
  print_rivals(comparisons, limit);
  print_meshing(comparisons);
  print_stages(comparisons);
  print_disturbance(comparisons);
  return comparisons;
}

}  // namespace benchmark
