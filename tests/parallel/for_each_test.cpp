// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/for_each.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "parallel/shared_progress.hpp"

namespace {

using namespace qmorph::parallel;
using qmorph::Progress;
using qmorph::ProgressCallback;

TEST_CASE("side by side: every index once, with any number of threads, also inside one another") {
  for (int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> calls(100);
    with_threads(threads, [&] {
      for_each_index(10, [&](std::size_t i) { for_each_index(10, [&](std::size_t j) { ++calls[10 * i + j]; }); });
    });
    for (const auto& count : calls) CHECK(count == 1);
  }
  for_each_index(0, [](std::size_t) { FAIL("nothing to do"); });
}

TEST_CASE("side by side: of several exceptions the one with the lowest index is thrown, after all other work is done") {
  std::atomic<int> done = 0;
  std::string message;
  try {
    for_each_index(50, [&](std::size_t i) {
      if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      ++done;
    });
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  CHECK(message == "7");
  CHECK(done == 45);
}

TEST_CASE("side by side: the share of all parts together grows by their weights and never falls") {
  std::vector<double> shares;
  const auto note = [&](std::string_view, double share) {
    shares.push_back(share);
    return Progress::go_on;
  };
  const SharedProgress shared(note, 10);
  const ProgressCallback small = shared.part(2), large = shared.part(8);
  small("front", 0.5), large("front", 0.5), small("front", 1), large("front", 0.25), large("front", 1);
  const std::vector<double> wanted = {0.1, 0.5, 0.6, 0.6, 1};
  REQUIRE(shares.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(shares[i] == doctest::Approx(wanted[i]));
  CHECK_FALSE(SharedProgress({}, 10).part(1));
}

}  // namespace
