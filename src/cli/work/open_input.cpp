// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/work/open_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/messages/outcome.hpp"
#include "cli/process/reading_limits.hpp"
#include "gmsh/read/dialect.hpp"
#include "gmsh/read/meshing.hpp"
#include "gmsh/read/raise.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// Says what it is at, so that a crash of Gmsh's becomes a message.
adapter::OpenedModel open_input(const Call& call, adapter::OpenOptions options) {
  const std::string name = name_of_input(call.request);
  std::optional<ReadingLimits> limits;
  std::vector<std::string> files = options.merged;
  files.push_back(call.request.input);
  if (call.process.slate) limits.emplace(files);
  call.begin(bad_input, name + " cannot be read: Gmsh crashed" + adapter::describe_dialect(call.request.input));
  options.when_read = [&] {
    limits.reset();
    call.begin(bad_input, name + " cannot be meshed: Gmsh crashed");
  };
  adapter::OpenedModel opened = adapter::open_model(call.request.input, options);
  call.begin(bad_input, "a crash while qmorph worked on " + name);
  return opened;
}

/// A geometry is meshed with Gmsh's number of segments on the curves that are named; a mesh has its segments, and only
/// --all-quad would change them.
void check_kept_curves(const Request& request, bool had_mesh) {
  if (request.keep_curves.empty() || request.all_quad) return;  // --all-quad sees to it itself
  if (had_mesh)
    throw UsageError("--keep-curves: curves of a mesh get no node without --all-quad; leave --keep-curves out");
  ::gmsh::vectorpair curves;
  ::gmsh::model::getEntities(curves, 1);
  for (const int tag : request.keep_curves)
    if (std::find(curves.begin(), curves.end(), std::pair(1, tag)) == curves.end())
      throw UsageError(fmt::format("the model has no curve {}", tag));
}

}  // namespace

void begin_session(const Call& call, adapter::Session& session) {
  if (!call.process.slate) return;
  session.leave();
  const std::string& complaint = session.complaint();
  if (complaint.empty()) return;
  if (complaint.rfind("Unknown", 0) != 0) throw InputError("the options cannot be understood: " + complaint);
  const std::vector<std::string>& named = call.request.option_names;  // which have a warning of their own
  if (std::none_of(named.begin(), named.end(),
                   [&](const std::string& name) { return complaint.find(name) != std::string::npos; }))
    call.warn(complaint);
}

adapter::OpenedModel open_as_it_is(const Call& call) {
  const Request& request = call.request;
  return open_input(call,
                    {.merged = request.merged, .no_meshing = true, .ignore_periodicity = request.ignore_periodicity});
}

adapter::OpenedModel open_for_conversion(const Call& call, const adapter::OutputPlan& plan) {
  const Request& request = call.request;
  if (!request.algorithm_chosen) adapter::set_option("Mesh.Algorithm", adapter::kDefaultAlgorithm);
  if (plan.format.quad_nodes == 8) adapter::set_option("Mesh.SecondOrderIncomplete", 1);
  for (const std::string& name : request.option_names)
    if (!adapter::option_exists(name)) call.warn("this Gmsh has no option " + name);
  adapter::OpenedModel opened = open_input(call, {.merged = request.merged,
                                                  .background = request.background,
                                                  .no_meshing = request.no_meshing,
                                                  .ignore_periodicity = request.ignore_periodicity,
                                                  .becomes_layers = request.layers,
                                                  .keep_curves = request.keep_curves});
  check_kept_curves(request, opened.had_mesh);
  if (request.drop_volumes) adapter::drop_volumes();
  if (request.verbosity >= 1) name_ignored_options(request, opened, call.err);
  if (request.order_chosen) adapter::lower_model(static_cast<int>(adapter::get_option("Mesh.ElementOrder")));
  if (request.consumer.empty()) {
    const int raised = static_cast<int>(adapter::get_option("Mesh.ElementOrder")), has = adapter::order_of_surfaces();
    adapter::check_elements(plan, has > 1 ? has : raised);
  }
  return opened;
}

}  // namespace qmorph::cli
