// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/engine_options.hpp"

#include <fmt/format.h>

#include <string>

#include "cli/request/value.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// NAME=VALUE of --set.
void apply(const std::string& setting, Options& options) {
  const std::size_t equals = setting.find('=');
  const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
  const auto number = to_number(value);
  if (!number) throw UsageError(fmt::format("--set {}: it takes NAME=NUMBER", setting));
  try {
    set_option(options, setting.substr(0, equals), *number);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--set: {}", error.what()));
  }
}

}  // namespace

Options engine_options(const Request& request) {
  Options options;
  options.threads = request.threads;
  options.layers = request.layers;
  if (request.crease) set_option(options, "crease_angle", *request.crease);
  if (request.smoothing == "thesis")
    options.smoothing.method = SmoothingMethod::thesis;
  else if (!request.smoothing.empty() && request.smoothing != "shape_energy")
    throw UsageError(fmt::format("--smoothing: '{}' is neither shape_energy nor thesis", request.smoothing));
  for (const std::string& setting : request.settings) apply(setting, options);
  return options;
}

}  // namespace qmorph::cli
