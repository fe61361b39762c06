// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where a region of a curved surface is cut, so that each of its parts can be laid flat.

#include <memory>

#include "chart/chart.hpp"

namespace qmorph::chart {

/// A piece with its chart.
struct LaidOut {
  Piece piece;
  Chart chart;
  LaidOut(const SurfaceMesh& mesh, const std::vector<Index>& opposite, const std::vector<bool>& is_cut,
          const std::vector<Index>& faces)
      : piece(mesh, opposite, is_cut, faces), chart(piece) {}
  explicit LaidOut(Piece&& its_piece, int rounds = kAllRounds) : piece(std::move(its_piece)), chart(piece, rounds) {}
};

struct Division {
  std::vector<bool> is_cut;  ///< by side of the mesh
  std::vector<std::vector<Index>> parts;
  std::vector<std::unique_ptr<LaidOut>> laid_out;  ///< of each part; null where nobody had to see its chart
};

struct DivisionSettings {
  std::size_t most_faces = 60'000;  ///< of a part, more or less: larger charts cost more than they are worth
  bool at_a_glance = false;  ///< large pieces are judged by a few of their points, for those who lay the parts out anew
  bool keeps_lengths = true;  ///< as well in large parts as in small ones: where triangles say how to stretch quads
};

/// Parts with a good chart and not many more faces than asked for. What a good chart has is not cut: discs that are
/// curved little, annuli that lie flat. A tube is opened from one end to the other, a cone from its tip to its rim;
/// what is curved more, and what has handles or no boundary, is cut in two along the shortest plane curve that does it,
/// again and again. What cannot be cut any more may have a chart that is turned over here and there.
/// \param is_cut sides that are cut already: creases
Division divide(const SurfaceMesh& mesh, const std::vector<Index>& opposite, std::vector<bool> is_cut,
                const DivisionSettings& settings);

}  // namespace qmorph::chart
