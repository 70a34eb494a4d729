#include "objects/prints.h"

#include "objects/april_tags.h"

namespace understudy::objects {
namespace {

CellGrid Checkers(std::size_t rows, std::size_t columns) {
  CellGrid grid(rows, std::vector<bool>(columns));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      grid[row][column] = (row + column) % 2 == 0;
    }
  }
  return grid;
}

CellGrid GridOf(const ObjectSpec& object) {
  switch (KindOf(object).print.pattern) {
    case Pattern::kAprilTag:
      return AprilTag(object.id);
    case Pattern::kCheckers:
      return Checkers(7, 9);
    case Pattern::kPicture:  // of no cells
    case Pattern::kNone:
      break;
  }
  return {};
}

}  // namespace

std::vector<Print> PrintsOf(const ObjectSpec& object) {
  const CellGrid grid = GridOf(object);
  if (grid.empty()) return {};
  const double cell = KindOf(object).print.cell, middle = KindOf(object).height / 2;
  const std::size_t rows = grid.size(), columns = grid[0].size();
  std::vector<Print> prints;
  // Of the cells from (row, column) on, so many down and to the right.
  const auto add = [&](std::size_t row, std::size_t column, std::size_t down, std::size_t right) {
    const auto half = [](std::size_t count) { return static_cast<double>(count) / 2; };
    prints.push_back({.at = {cell * (half(2 * column + right) - half(columns)),
                             middle - cell * (half(2 * row + down) - half(rows))},
                      .half = {cell * half(right), cell * half(down)}});
  };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      if (!grid[row][column]) continue;
      std::size_t right = 1, down = 1;
      if (column == 0 || !grid[row][column - 1]) {
        while (column + right < columns && grid[row][column + right]) ++right;
        add(row, column, 1, right);
      }
      if (row == 0 || !grid[row - 1][column]) {
        while (row + down < rows && grid[row + down][column]) ++down;
        add(row, column, down, 1);
      }
    }
  }
  return prints;
}

}  // namespace understudy::objects
