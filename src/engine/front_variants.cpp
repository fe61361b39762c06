// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/front_variants.hpp"

#include <span>

namespace qmorph {
namespace {

struct Factors {
  double corner, side, transition = 1, seam = 1;
};

std::vector<Options> multiplied(const Options& asked, std::span<const Factors> factors) {
  std::vector<Options> variants(factors.size(), asked);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    FrontOptions& front = variants[i].front;
    front.corner_angle *= factors[i].corner;
    front.side_edge_angle *= factors[i].side;
    front.transition_ratio *= factors[i].transition;
    front.seam_angle *= factors[i].seam;
    front.seam_angle_many *= factors[i].seam;
  }
  return variants;
}

}  // namespace

std::vector<Options> front_variants(const Options& asked) {
  constexpr Factors kFactors[] = {{0.85, 1.5, 0.85, 1}, {0.9, 1, 1, 0.5},        {0.8, 3, 0.5, 1.5},
                                  {1.1, 0.5, 0.7, 1},   {0.95, 1.5, 0.85, 0.25}, {0.85, 2, 1.3, 1},
                                  {0.9, 0.5, 0.7, 1},   {0.75, 2, 0.85, 1},      {0.85, 0.75, 0.85, 0.5},
                                  {0.85, 1.5, 0.5, 1},  {0.9, 1.5, 0.7, 1},      {1.1, 0.75, 1.3, 0.25},
                                  {0.85, 0.75, 1, 1},   {1, 0.5, 0.7, 0.5},      {0.75, 1, 0.6, 1},
                                  {1.1, 1.5, 1, 1},     {0.95, 0.3, 0.85, 0.25}, {0.8, 3, 1, 1}};
  return multiplied(asked, kFactors);
}

std::vector<Options> few_front_variants(const Options& asked) {
  constexpr Factors kFactors[] = {{1, 0.5},   {1, 1.5}, {0.9, 1},   {0.9, 0.5},
                                  {0.9, 1.5}, {1.1, 1}, {1.1, 0.5}, {1.1, 1.5}};
  return multiplied(asked, kFactors);
}

}  // namespace qmorph
