// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "engine/canonical/frame.hpp"
#include "qmorph/observer.hpp"

namespace qmorph::canonical {

/// Tells of fronts in a frame what they are in the model, seen from the side of the caller's elements.
class FrameObserver : public Observer {
 public:
  FrameObserver(Observer& observer, const Frame& frame) : observer_(observer), frame_(frame) {}
  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override;
  bool wants_stages() const override { return observer_.wants_stages(); }
  /// What front_starts() of the caller's observer has returned for a front that was kept.
  std::unique_ptr<FrontObserver> callers(std::unique_ptr<FrontObserver> front) const;

 private:
  Observer& observer_;
  Frame frame_;
};

}  // namespace qmorph::canonical
