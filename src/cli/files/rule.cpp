// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/files/rule.hpp"

#include <vector>

#include "gmsh/read/sources.hpp"

namespace qmorph::cli {

std::string rule_for_make(const Request& request, const adapter::OpenedModel& opened, const adapter::OutputPlan& plan) {
  std::vector<std::string> files{request.input};
  files.insert(files.end(), request.merged.begin(), request.merged.end());
  if (!request.background.empty()) files.push_back(request.background);
  files.insert(files.end(), request.option_files.begin(), request.option_files.end());
  files.push_back(request.input + ".opt");  // Gmsh takes it by itself
  files.insert(files.end(), opened.sources.begin(), opened.sources.end());
  return adapter::make_rule(plan.path, adapter::with_named_files(files));
}

}  // namespace qmorph::cli
