// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/work/check_file.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "cli/messages/outcome.hpp"
#include "cli/process/standard_streams.hpp"
#include "cli/work/open_input.hpp"
#include "cli/work/verdict.hpp"
#include "gmsh/read/readable.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/gmsh.hpp"
#include "report/summary.hpp"

namespace qmorph::cli {
namespace {

/// The surfaces of the file that the mesh is measured against.
std::map<int, Patch> read_reference(const Request& request) {
  if (request.against.empty()) return {};
  adapter::check_readable(request.against);
  const adapter::Session session(request.gmsh_arguments);
  adapter::open_model(request.against, {.no_meshing = true, .ignore_periodicity = request.ignore_periodicity});
  std::map<int, Patch> surfaces = session::read_surfaces();
  if (surfaces.empty())
    throw InputError(fmt::format("--against {}: it has no mesh of surfaces to measure by", request.against));
  return surfaces;
}

ModelReport measure(const Call& call) {
  const StdoutAsStderr redirected;
  const std::map<int, Patch> before = read_reference(call.request);
  adapter::Session session(call.request.gmsh_arguments);
  begin_session(call, session);
  open_as_it_is(call);
  return session::measure_surfaces(call.request.surfaces, before);
}

}  // namespace

int check_file(const Call& call) {
  const Request& request = call.request;
  adapter::check_readable(request.input);
  const ModelReport model = measure(call);
  if (model.surfaces.empty()) throw InputError(fmt::format("{} has no surface with elements", name_of_input(request)));
  if (request.verbosity >= 1) answer(report::check_line(model) + '\n', call.out);
  const std::vector<std::string> reasons = find_reasons(model, request.thresholds);
  for (const std::string& reason : reasons) call.err << "qmorph: " << reason << '\n';
  return reasons.empty() ? all_converted : not_good_enough;
}

}  // namespace qmorph::cli
