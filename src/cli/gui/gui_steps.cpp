// SPDX-License-Identifier: GPL-2.0-or-later
// The buttons below "Step".
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cli/gui/gui.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// That has triangles, of those that are wanted; 0 if there is none.
int first_surface(const adapter::ModelMesh& mesh, const std::vector<int>& wanted) {
  for (const adapter::EntityMesh& entity : mesh.entities)
    if (entity.dim == 2 && entity.polygons(3) &&
        (wanted.empty() || std::count(wanted.begin(), wanted.end(), entity.tag)))
      return entity.tag;
  return 0;
}

}  // namespace

void Gui::leave_front() {
  if (!player_) return;
  adapter::show_surface(player_->surface(), true);
  adapter::show_curves(true);
  adapter::set_parameter(parameter::kStepDone, std::string());
  adapter::set_parameter(parameter::kStepWords, std::string());
  views_.clear();
  player_.reset();
}

/// Converts with an eye on one surface, and goes back to its triangles. \return false if it has no front
bool Gui::record() {
  choices_ = read_choices();
  const Request request = read_request(call_.request);
  if (request.cleanup_only) throw UsageError("Clean up only: there is no front then");
  std::optional<FrontWatcher> watcher;
  const auto watch = [&] {
    const int chosen = choices_.step_surface;
    return &watcher.emplace(chosen ? chosen : first_surface(document_.triangles().mesh, request.surfaces));
  };
  if (!convert(watch)) return false;
  const int surface = watcher->surface();
  std::vector<std::unique_ptr<FrontLog>> logs = watcher->take();
  if (logs.empty())
    throw InputError(fmt::format(
        "surface {} has no front: it is not there, or nothing of it was converted; choose another below Step",
        surface));
  document_.back_to_triangles();
  player_.emplace(surface, std::move(logs));
  return true;
}

void Gui::step(const std::string& name) {
  const Choices now = read_choices();
  if (player_ && now.step_surface != 0 && now.step_surface != player_->surface()) leave_front();
  if (!player_ && !record()) return;
  choices_ = now;
  const std::size_t n = static_cast<std::size_t>(std::max(1, now.steps)), at = player_->position();
  const bool row = now.steps == kWholeRow;
  std::size_t to = 0;
  if (name == action::kForward) to = row ? player_->row_end() : at + n;
  if (name == action::kBackward) to = row ? player_->row_begin() : at - std::min(at, n);
  if (name == action::kToEnd) to = player_->count();
  player_->go_to(to);
  const bool end = player_->position() == player_->count();
  if (end != !document_.shows_triangles()) end ? document_.forward_to_quads() : document_.back_to_triangles();
  if (end) adapter::show_surface(player_->surface(), true), adapter::show_curves(true);
  show_figures(end ? &document_.converted()->model : nullptr, document_.converted()->seconds);
  adapter::set_parameter(parameter::kStepDone, fmt::format("{} of {}", player_->position(), player_->count()));
  adapter::set_parameter(parameter::kStepWords, player_->words());
  show();
  window_.status(player_->words());
}

}  // namespace qmorph::cli
