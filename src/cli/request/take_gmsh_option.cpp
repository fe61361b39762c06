// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/take_gmsh_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/request/value.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

double msh_version(const std::string& text) {
  constexpr std::array kVersions = {1.0, 2.0, 2.1, 2.2, 3.0, 4.0, 4.1};
  const double version = std::stod(text);
  if (std::find(kVersions.begin(), kVersions.end(), version) == kVersions.end())
    throw UsageError(fmt::format("Mesh.MshFileVersion: there is no version '{}' (1, 2.2, 3, 4, 4.1)", text));
  return version;
}

}  // namespace

void take_gmsh_option(const GmshOptionRow& row, const std::vector<std::string>& values, Request& request) {
  if (row.kind == GmshOption::refused) throw UsageError(fmt::format("-{}: not here; {}", row.name, row.note));
  if (row.kind == GmshOption::nothing) return;
  check_gmsh_values(row, values);
  request.gmsh_arguments.push_back(fmt::format("-{}", row.name));
  request.gmsh_arguments.insert(request.gmsh_arguments.end(), values.begin(), values.end());
  if (says_how_to_mesh(row.name)) request.meshing_words.push_back(fmt::format("-{}", row.name));
  if (row.name == "algo") request.algorithm_chosen = true;
  if (row.name == "bgm") request.background = values[0];
  if (row.name == "option") request.option_files.push_back(values[0]);
  if (row.name == "ignore_periodicity") request.ignore_periodicity = true;
  if (row.name == "order" || row.name == "degree") request.order_chosen = true;
  if (row.name != "setnumber" && row.name != "setstring") return;
  // Names without a dot are constants of the script.
  if (values[0].find('.') != std::string::npos) request.option_names.push_back(values[0]);
  if (row.name != "setnumber") return;
  if (says_how_to_mesh(values[0])) request.meshing_words.push_back(values[0]);
  if (values[0] == "Mesh.Algorithm") request.algorithm_chosen = true;
  if (values[0] == "Mesh.ElementOrder") request.order_chosen = true;
  if (values[0] == "Mesh.MshFileVersion") request.msh_version = msh_version(values[1]);
  if (values[0] == "Mesh.Binary") request.binary = std::stod(values[1]) != 0;
}

}  // namespace qmorph::cli
