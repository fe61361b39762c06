// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/front_variants.hpp"

#include <iterator>

namespace qmorph {

std::vector<Options> front_variants(const Options& asked) {
  struct Factors {
    double corner, side, transition, seam;
  };
  constexpr Factors kFactors[] = {{0.85, 1.5, 0.85, 1}, {0.9, 1, 1, 0.5},        {0.8, 3, 0.5, 1.5},
                                  {1.1, 0.5, 0.7, 1},   {0.95, 1.5, 0.85, 0.25}, {0.85, 2, 1.3, 1},
                                  {0.9, 0.5, 0.7, 1},   {0.75, 2, 0.85, 1},      {0.85, 0.75, 0.85, 0.5},
                                  {0.85, 1.5, 0.5, 1},  {0.9, 1.5, 0.7, 1},      {1.1, 0.75, 1.3, 0.25},
                                  {0.85, 0.75, 1, 1},   {1, 0.5, 0.7, 0.5},      {0.75, 1, 0.6, 1},
                                  {1.1, 1.5, 1, 1},     {0.95, 0.3, 0.85, 0.25}, {0.8, 3, 1, 1}};
  std::vector<Options> variants(std::size(kFactors), asked);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    FrontOptions& front = variants[i].front;
    front.corner_angle *= kFactors[i].corner;
    front.side_edge_angle *= kFactors[i].side;
    front.transition_ratio *= kFactors[i].transition;
    front.seam_angle *= kFactors[i].seam;
    front.seam_angle_many *= kFactors[i].seam;
  }
  return variants;
}

}  // namespace qmorph
