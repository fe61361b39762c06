// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/replace_cavities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "cleanup/attempt.hpp"
#include "cleanup/cavity.hpp"
#include "cleanup/element_size.hpp"
#include "cleanup/filling_choice.hpp"
#include "cleanup/nearest_nodes.hpp"
#include "cleanup/node_queue.hpp"

namespace qmorph::cleanup {
namespace {

constexpr int kRings = 1;

constexpr double kFloor = 0.4;

/// To try a filling of a large cavity is dear, and only those have a chance whose corners are where the outline turns.
constexpr std::size_t kLargeCavity = 4000;
constexpr double kMostMisfit = 0.02;  ///< a corner of 65 degrees has as much
bool has_chance(const Cavity& cavity, const FillingChoice& choice, int tries) {
  return cavity.faces().size() <= kLargeCavity || (tries == 1 && choice.misfit < kMostMisfit);
}

/// How well the best filling of a region of so many quads has to fit its outline. A region as a whole is dear to fill,
/// and only its best filling was ever accepted: 30 in some 100 models, of which those of more than 100 quads fitted
/// better than 0.08, those of more than 250 better than 0.00001.
double most_misfit_of_whole(std::size_t quads) {
  constexpr std::size_t kSmall = 100, kLarge = 500;
  constexpr double kMostMisfitOfMiddling = 0.1;
  if (quads <= kSmall) return std::numeric_limits<double>::infinity();
  return quads <= kLarge ? kMostMisfitOfMiddling : kMostMisfit;
}

/// What the mean shape may lose by better valences, and all elements together.
constexpr double kMeanLoss = 0.02, kLossOfAll = 1.5;

/// Better valences may cost a little shape: the worst corner may fall, but not under the floor (unless it was lower
/// before), and the mean hardly, nor all elements together.
bool is_good_enough(const Worth& before, const Worth& after) {
  const double loss = before.mean - after.mean;
  return after.worst >= std::min(before.worst, kFloor) && loss <= kMeanLoss && loss * double(after.faces) <= kLossOfAll;
}

/// Shape that the passes which are left will not make up for: of 491 fillings of 100 quads and more that were good
/// enough in the end one had lost more on the way. Such cavities take most of the time, and without this three of four
/// tries in them are refused after all passes. Small ones are cheap, and less certain.
bool is_hopeless(const Worth& before, const Worth& now, int pass) {
  constexpr std::array kMadeUp{0.14, 0.08, 0.055, 0.032, 0.015};  // of the mean, by the passes that are done
  const double most = std::min(kMeanLoss, kLossOfAll / double(now.faces));
  return std::size_t(pass) < kMadeUp.size() && before.mean - now.mean > most + kMadeUp[std::size_t(pass)];
}
constexpr GivingUp kGivingUp{.least_faces = 100, .is_hopeless = is_hopeless};

/// The worst corner gains visibly, and the mean hardly loses.
bool is_better_shape(const Worth& before, const Worth& after) {
  constexpr double kGain = 0.05, kLittle = 0.01;
  return after.worst >= before.worst + kGain && after.mean >= before.mean - kLittle;
}

class Replacing {
 public:
  Replacing(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget,
            const CavityLimits& limits = {}, Refused* refused = nullptr)
      : mesh_(mesh),
        score_(mesh),
        size_(mesh),
        cavity_(mesh),
        nearest_(mesh),
        relaxing_(smoothing),
        budget_(budget),
        limits_(limits),
        refused_(refused) {
    relaxing_.iterations = limits.iterations;
    relaxing_.untangling_sweeps = 8;  // a filling that needs more does not fit
  }

  void run(const std::vector<Index>& nodes) {
    for (Index v : nodes) enqueue(v);
    std::size_t most = 4 * mesh_.vertex_slots() + 1000;
    while (!queue_.empty() && most-- > 0 && !budget_.is_spent()) {
      const Index v = queue_.pop();
      if (!is_defect(v) || (refused_ && refused_->holds(v, kNearby))) continue;
      depends_on_size_ = false;
      if (improve(v, is_good_enough, 1)) {
        for (Index u : nodes_)
          if (mesh_.is_live_vertex(u)) enqueue(u);
      } else if (refused_ && !depends_on_size_ && !budget_.is_spent()) {
        refused_->note(v);  // sizes are measured anew before it is asked again
      }
    }
  }

  /// A region with three to five sides may have a filling as a whole, which no cavity inside can find.
  bool replace_all() {
    constexpr double kUniform = 1.6;  // a filling does not know of sizes inside
    const auto is_better = [](const Worth& before, const Worth& after) {
      return after.worst >= std::min(before.worst, kFloor) && after.mean >= before.mean;
    };
    bool defects = false;
    for (Index v = 0; v < mesh_.vertex_slots() && !defects; ++v) defects = is_defect(v);
    return defects && may_fit_as_whole() && size_.is_uniform(kUniform) && cavity_.start_with_all() &&
           replace(is_better, 1, Extent::whole);
  }

  /// Valences as good as they are may give a poor quad a better shape.
  void raise(Index poor) {
    failed_.resize(mesh_.vertex_slots(), kNone);
    for (Index v : topology::nodes_of(mesh_, poor)) {
      if (!is_defect(v) || failed_[v] == changes_) continue;  // tried from another quad, and nothing has changed since
      if (improve(v, is_better_shape, 0)) return;
      failed_[v] = Index(changes_);
    }
  }

  std::size_t changes() const { return changes_; }

 private:
  /// False if no filling fits the outline of the region: the angles there tell that at once, nearly always.
  bool may_fit_as_whole() const {
    constexpr double kRounding = 1e-6;
    std::size_t quads = 0;
    for (Index f = 0; f < mesh_.face_slots(); ++f) {
      if (mesh_.is_live_face(f) && !mesh_.is_quad(f)) return false;
      quads += mesh_.is_live_face(f);
    }
    const double most = most_misfit_of_whole(quads);
    return std::isinf(most) || least_misfit(mesh_, score_) < most + kRounding;
  }

  bool is_defect(Index v) const { return mesh_.is_live_vertex(v) && mesh_.is_free(v) && score_.excess(v) != 0; }

  void enqueue(Index v) {
    if (is_defect(v)) queue_.push(v);
  }

  /// Grows a cavity from v to one irregular node after another, the nearest first, until a filling is accepted that
  /// costs less by `gain`. True if there was one.
  template <class Accept>
  bool improve(Index v, const Accept& accept, double gain) {
    if (mesh_.valence(v) > kMostValence || !cavity_.start(v)) return false;
    mesh_.add_work(cavity_.faces().size());
    if (replace(accept, gain)) return true;
    nearest_.start(v);
    for (int reached = 0; reached < limits_.most_nodes && !budget_.is_spent();) {
      const Index u = nearest_.next(kMostLooks);
      if (u == kNone) return false;
      if (nearest_.edges() == kRegular) continue;  // nearly always
      if (score_.excess(u) == 0 || mesh_.valence(u) > kMostValence || cavity_.is_inside(u)) continue;
      ++reached;
      mesh_.add_work(cavity_.faces().size());
      if (cavity_.add_nodes(way_there(), limits_.most_quads) && replace(accept, gain)) return true;
    }
    return false;
  }

  /// The free nodes on the way from the cavity to the node that was nearest.
  const std::vector<Index>& way_there() {
    nearest_.way_back(way_, [&](Index w) { return cavity_.touches(w); });
    std::erase_if(way_, [&](Index w) { return !mesh_.is_free(w); });
    return way_;
  }

  enum class Extent { cavity, whole };

  template <class Accept>
  bool replace(const Accept& accept, double gain, Extent extent = Extent::cavity) {
    std::vector<Index> near = cavity_.inner_nodes();
    for (Index h : cavity_.outline()) near.push_back(mesh_.origin(h));
    double cost = 0;
    for (Index v : near) cost += score_.cost(v);
    if (!may_have_filling(mesh_, score_, cavity_, cost - gain)) return false;
    std::vector<Index> outline(near.end() - std::ptrdiff_t(cavity_.outline().size()), near.end());
    const double size = size_.mean(near);
    // With more passes than usual, more is made up for.
    const GivingUp* const giving_up = limits_.iterations == CavityLimits().iterations ? &kGivingUp : nullptr;
    const FillingChoices choices =
        choose_fillings(mesh_, score_, cavity_, cost - gain, size_.quads_wanted(cavity_.faces()), limits_.size);
    depends_on_size_ = depends_on_size_ || choices.depends_on_size;
    int tries = 0;
    for (const FillingChoice& choice : choices.best_first) {
      if (++tries > (extent == Extent::whole ? 1 : limits_.most_tries)) return false;
      if (extent == Extent::whole ? choice.misfit >= most_misfit_of_whole(cavity_.faces().size())
                                  : !has_chance(cavity_, choice, tries))
        return false;
      const auto edit = [&](std::vector<Index>& nodes) {
        const bool filled = choice.pair ? fill(mesh_, cavity_.outline(), cavity_.faces(), *choice.pair, nodes)
                                        : fill(mesh_, cavity_.outline(), cavity_.faces(), choice.filling, nodes);
        return filled && settle(std::span(nodes).subspan(cavity_.outline().size()));
      };
      if (!attempt(mesh_, relaxing_, kRings, near, nodes_, edit, accept, giving_up)) continue;
      ++changes_;
      if (refused_) refused_->note_change();
      std::sort(outline.begin(), outline.end());
      for (Index v : nodes_)
        if (!std::binary_search(outline.begin(), outline.end(), v)) size_.set(v, size);
      return true;
    }
    return false;
  }

  /// A guess of where new nodes are becomes a better one: each goes to the middle of its neighbours. False if so many
  /// elements are folded then that it is not worth the trouble.
  bool settle(std::span<const Index> nodes) {
    constexpr int kSweeps = 5;
    constexpr double kMostFolded = 0.02;
    topology::spread(mesh_, nodes, kSweeps);
    const std::vector<Index> faces = topology::faces_around(mesh_, {nodes.begin(), nodes.end()});
    mesh_.add_work(faces.size());
    const auto folded = std::count_if(faces.begin(), faces.end(), [&](Index f) { return !mesh_.is_valid_face(f); });
    return double(folded) <= kMostFolded * double(faces.size());
  }

  static constexpr int kRegular = 4;              ///< edges at a free node
  static constexpr std::size_t kMostLooks = 600;  ///< nodes among which irregular ones are looked for
  /// Nodes that decide whether to look again: about as many as a large cavity has. With 600 three times as many are
  /// looked at again, and nothing more is found in half a million quads; with 100 it is not the same any more.
  static constexpr std::size_t kNearby = 200;

  kernel::Mesh& mesh_;
  Score score_;
  ElementSize size_;
  Cavity cavity_;
  NearestNodes nearest_;
  std::vector<Index> way_;  ///< from a node to the cavity
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
  const CavityLimits limits_;
  Refused* const refused_;
  NodeQueue queue_;
  std::vector<Index> nodes_;
  std::vector<Index> failed_;     ///< by node: how many changes there had been when raise() found nothing for it
  bool depends_on_size_ = false;  ///< whether improve() passed over fillings for their number of quads
  std::size_t changes_ = 0;
};

}  // namespace

std::size_t replace_cavities(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget,
                             const CavityLimits& limits, Refused* refused) {
  std::vector<Index> nodes(mesh.vertex_slots());
  std::iota(nodes.begin(), nodes.end(), Index(0));
  Replacing replacing(mesh, smoothing, budget, limits, refused);
  replacing.run(nodes);
  if (!budget.is_spent()) replacing.replace_all();
  return replacing.changes();
}

std::size_t replace_cavities_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing,
                                  const std::vector<Index>& nodes, const kernel::Budget& budget,
                                  const CavityLimits& limits) {
  Replacing replacing(mesh, smoothing, budget, limits);
  replacing.run(nodes);
  return replacing.changes();
}

std::size_t replace_poor_cavities(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  constexpr double kPoor = 0.6;
  constexpr std::size_t kUsualWork = 5'000;  // of a poor face
  std::vector<Index> poor;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f) && !mesh.is_above(f, kPoor)) poor.push_back(f);
  if (poor.empty()) return 0;
  Replacing replacing(mesh, smoothing, budget);
  if (budget.is_short_for(poor.size(), kUsualWork)) poor = worst_first(mesh, std::move(poor));
  for (Index f : poor)
    if (!budget.is_spent() && mesh.is_live_face(f) && !mesh.is_above(f, kPoor)) replacing.raise(f);
  return replacing.changes();
}

}  // namespace qmorph::cleanup
