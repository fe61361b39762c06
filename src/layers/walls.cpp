// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/walls.hpp"

#include <algorithm>
#include <deque>

namespace qmorph::layers {
namespace {

/// How many times longer than high a cell must be to begin a column: between two other columns, and where it continues
/// a row.
constexpr double kStartBetween = 1.8, kStartBeside = 1;
/// Heights in the first row do not differ by more, if only the row is a reason to start.
constexpr double kSameRow = 1.5;

/// Walls by number, with what may stand on them.
class FirstRow {
 public:
  explicit FirstRow(Cells& cells) : cells_(cells), sides_(cells.sides()), number_(sides_.count(), kNone) {
    for (Index c = 0; c < sides_.count(); ++c)
      if (sides_.is_wall(c)) {
        number_[c] = Index(columns_.size());
        columns_.push_back(column_on_wall(sides_, c));
      }
  }

  std::vector<Column> take() {
    std::vector<double> aspect(columns_.size(), 0);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto cell = best_cell(cells_, columns_[i]);
      if (cell && misfit(sides_, *cell, columns_[i]) <= kMisfitBeside) aspect[i] = cell->aspect();
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Index wall = columns_[i].base;
      const double least =
          std::min(aspect[number_[sides_.next_wall(wall)]], aspect[number_[sides_.previous_wall(wall)]]);
      if (aspect[i] >= kStart || (aspect[i] >= kStartBetween && least >= kStart))
        start(Index(i), kStartBetween, kMisfitBeside);
    }
    drop_lone_ones();
    go_on_along_walls();
    std::erase_if(columns_, [](const Column& column) { return column.cells.empty(); });
    return std::move(columns_);
  }

  /// Those that go on along the wall from cells that stand there already.
  std::vector<Column> take_beside() {
    std::vector<bool> stood(columns_.size(), false);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Index wall = columns_[i].base, cell = cells_.owner(wall / 3);
      if (cell == kNone || (cells_[cell].base != wall && cells_[cell].top != wall)) continue;
      columns_[i].cells.push_back(cell);
      columns_[i].height = cells_[cell].height;
      started_.push_back(wall);
      stood[i] = true;
    }
    go_on_along_walls();
    std::vector<Column> taken;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (!stood[i] && !columns_[i].cells.empty()) taken.push_back(std::move(columns_[i]));
    return taken;
  }

 private:
  bool start(Index i, double least_aspect, double most_misfit) {
    Column& column = columns_[i];
    const auto cell = best_cell(cells_, column);
    if (!cell || cell->aspect() < least_aspect || misfit(sides_, *cell, column) > most_misfit) return false;
    const Index wall = column.base;
    grow(sides_, column, cells_.take(*cell), *cell);
    started_.push_back(wall);
    return true;
  }

  /// Some cells much longer than high on top of one another are a layer, whatever is beside them.
  bool is_pile(Column column) const {
    constexpr double kVeryLong = 5;
    for (std::size_t row = 0; row < kRow; ++row) {
      const auto cell = row == 0 ? std::optional(cells_[column.cells[0]]) : best_cell(cells_, column);
      if (!cell || cell->aspect() < kVeryLong || (row > 0 && !goes_on(sides_, column, *cell, false))) return false;
      if (row > 0) grow(sides_, column, kNone, *cell);
    }
    return true;
  }

  void drop_lone_ones() {
    std::vector<Column*> lone;
    for (Column& column : columns_)
      if (!column.cells.empty() && cells_.row_length(column.cells[0], 0, kRow) < kRow && !is_pile(column))
        lone.push_back(&column);
    for (Column* column : lone) {
      const Index wall = cells_[column->cells[0]].base;
      cells_.drop(column->cells[0]);
      *column = column_on_wall(sides_, wall);
    }
  }

  void go_on_along_walls() {
    while (!started_.empty()) {
      const Index wall = started_.front();
      started_.pop_front();
      if (columns_[number_[wall]].cells.empty()) continue;
      const double height = columns_[number_[wall]].height;
      for (Index c : {sides_.next_wall(wall), sides_.previous_wall(wall)}) {
        Column& column = columns_[number_[c]];
        if (!column.cells.empty()) continue;
        const auto cell = best_cell(cells_, column);
        if (!cell || !cells_.has_neighbour(*cell)) continue;
        if (cell->height <= kSameRow * height && height <= kSameRow * cell->height)
          start(number_[c], kStartBeside, kMisfit);
      }
    }
  }

  Cells& cells_;
  const Sides& sides_;
  std::vector<Index> number_;  ///< by side
  std::vector<Column> columns_;
  std::deque<Index> started_;  ///< walls whose neighbours have not been looked at
};

/// Cells that look like the ones below, for the columns of these numbers; kNone where there is none.
std::vector<Index> take_row(Cells& cells, const std::vector<Column>& columns, const std::vector<Index>& growing) {
  std::vector<Index> row(growing.size(), kNone);
  for (const bool looks_beside : {false, true})
    for (std::size_t i = 0; i < growing.size(); ++i) {
      if (row[i] != kNone) continue;
      const Column& column = columns[growing[i]];
      const auto cell = best_cell(cells, column);
      if (cell && goes_on(cells.sides(), column, *cell, looks_beside && cells.has_neighbour(*cell)))
        row[i] = cells.take(*cell);
    }
  return row;
}

}  // namespace

std::vector<Column> take_columns_on_walls(Cells& cells) {
  std::vector<Column> columns = FirstRow(cells).take();
  march(cells, columns);
  return columns;
}

void go_on_along_walls(Cells& cells) {
  std::vector<Column> columns = FirstRow(cells).take_beside();
  march(cells, columns);
}

void march(Cells& cells, std::vector<Column>& columns) {
  std::vector<Index> growing(columns.size());
  for (Index i = 0; i < columns.size(); ++i) growing[i] = i;
  while (!growing.empty()) {
    const Index first = Index(cells.size());
    const std::vector<Index> row = take_row(cells, columns, growing);
    std::vector<Index> loose;
    for (Index number : row)
      if (number != kNone && cells[number].aspect() < kNearIsotropic && cells.row_length(number, first, kRow) < kRow)
        loose.push_back(number);
    for (Index number : loose) cells.drop(number);
    std::vector<Index> still_growing;
    for (std::size_t i = 0; i < growing.size(); ++i) {
      if (row[i] == kNone || !cells.is_live(row[i])) continue;
      grow(cells.sides(), columns[growing[i]], row[i], cells[row[i]]);
      still_growing.push_back(growing[i]);
    }
    growing = std::move(still_growing);
  }
}

}  // namespace qmorph::layers
