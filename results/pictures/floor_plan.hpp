#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/pictures/drawing.hpp"

namespace ridgeloc::results {

/// How places of a kind are marked.
enum class PlanMark {
  Object,    ///< small grey dot
  Used,      ///< hollow grey square
  Filled,    ///< filled black circle
  Hollow,    ///< hollow black circle
  Cross,     ///< coloured cross
  Mean,      ///< coloured diamond
  Star,      ///< where something truly is
  GoodTile,  ///< squares of `FloorPlan::tile`, from what is wanted to what is not
  WrongTile,
  OutsideTile,
  LostTile
};

struct PlanPlaces {
  PlanMark mark = PlanMark::Object;
  std::vector<DrawnPoint> points;
};

/// One plan among several of the same floor.
struct PlanPanel {
  std::string title;
  std::vector<PlanPlaces> places;  ///< later ones lie above
};

/// What a mark stands for.
struct PlanKey {
  PlanMark mark = PlanMark::Object;
  std::string text;
};

/// Plans of one floor beside each other, from above, in one scale.
struct FloorPlan {
  std::string title;
  DrawingWindow window;
  std::vector<std::vector<DrawnPoint>> outlines;  ///< lines, of walls
  double tile = 1.0;                              ///< side of a tile, in the units of the plan
  std::vector<PlanPanel> panels;
  std::vector<PlanKey> keys;
  std::string footnote;
};

/// Draws the plans into a file; see `write_picture` for formats and errors. Precondition: there is a panel.
void draw(const FloorPlan& plan, const std::filesystem::path& output);

}  // namespace ridgeloc::results
