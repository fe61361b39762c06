// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/files/places.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "cli/files/side_files.hpp"
#include "gmsh/read/readable.hpp"
#include "gmsh/write/consumers.hpp"

namespace qmorph::cli {

namespace fs = std::filesystem;

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
  const fs::path second = fs::weakly_canonical(fs::absolute(b, error), error);
  return !first.empty() && first == second;
}

adapter::OutputPlan check_places(const Request& request) {
  adapter::check_readable(request.input);
  for (const std::string& file : request.merged) adapter::check_readable(file);
  for (const std::string& file : request.option_files) adapter::check_readable(file);
  std::vector<std::pair<std::string, std::string>> taken{{request.input, "the input"}};
  for (const auto& [option, path] : side_files(request)) {
    if (path == "-")
      throw UsageError(fmt::format("{} -: only the mesh goes to the standard output; give it a file", option));
    for (const auto& [other, what] : taken)
      if (is_same_file(path, other))
        throw UsageError(fmt::format("{} {} is {}; give it a file of its own", option, path, what));
    adapter::check_place(path);
    taken.emplace_back(path, fmt::format("the file of {}", option));
  }
  std::string format = request.format;
  if (!request.consumer.empty()) {
    const std::string_view wanted = adapter::find_consumer(request.consumer).format;
    if (!request.elements.empty() && !adapter::is_element_family(request.elements))
      throw UsageError(fmt::format("--elements: '{}' is none of CPS, CPE, CAX, S, M3D, with or without an R behind it",
                                   request.elements));
    if (!format.empty() && format != wanted)
      throw UsageError(fmt::format("--for {} writes the format {}, not {}", request.consumer, wanted, format));
    format = wanted;
  }
  adapter::OutputPlan plan = adapter::plan_output(request.input, request.output, format);
  plan.for_reader = !request.consumer.empty();
  if (request.to_stdout) plan.name = "standard output";
  for (const auto& [option, path] : side_files(request))
    if (is_same_file(path, plan.path))
      throw UsageError(fmt::format("{} {} is the output; give it a file of its own", option, path));
  return plan;
}

}  // namespace qmorph::cli
