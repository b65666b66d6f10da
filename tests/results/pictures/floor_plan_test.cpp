#include "results/pictures/floor_plan.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "core/error.hpp"
#include "results/pictures/floor_plan_script.hpp"
#include "results/pictures/gnuplot.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;
using tests::contains;

/// A room of 10 x 5 with a panel of places and one of tiles; one place of each lies outside of the window.
FloorPlan sample_plan() {
  FloorPlan plan;
  plan.title = "it's a floor";
  plan.window = {{0.0, 10.0}, {0.0, 5.0}};
  plan.outlines = {{{0, 0}, {10, 0}, {10, 5}, {0, 5}}, {{3, 0}, {3, 2}}};
  plan.tile = 2.0;
  plan.panels.push_back({"first", {{PlanMark::Star, {{1, 1}}}, {PlanMark::Filled, {{2, 2}, {1e6, -3}}}}});
  plan.panels.push_back({"second", {{PlanMark::GoodTile, {{4, 1}, {400, 1}}}, {PlanMark::LostTile, {}}}});
  plan.panels.push_back({"third", {{PlanMark::Object, {{7, 3}}}, {PlanMark::WrongTile, {{7, 3}}}}});
  plan.keys = {{PlanMark::Star, "truth"}, {PlanMark::GoodTile, "tile"}};
  plan.footnote = "note";
  return plan;
}

std::string script() {
  return floor_plan_script(sample_plan(), FigureFormat::Svg, "out.svg");
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (auto at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("a floor plan has one panel per method, in one window") {
  const std::string text = script();
  CHECK(contains(text, "set output " + gnuplot_string("out.svg")));
  for (const char* piece : {"it's a floor", "first", "second", "third", "note"})
    CHECK(count(text, gnuplot_string(piece)) == 1);
  CHECK(count(text, "set xrange [0:10]\nset yrange [0:5]") == 3);
  CHECK(count(text, "$outlines using 1:2 with lines") == 3);
  CHECK(count(text, gnuplot_string("x [m]")) == 2);  // below either column
  CHECK(count(text, gnuplot_string("y [m]")) == 2);  // beside either row
}

TEST_CASE("outlines are lines of their own") {
  CHECK(contains(script(), "$outlines << EOD\n0 0\n10 0\n10 5\n0 5\n\n3 0\n3 2\n\nEOD\n"));
}

TEST_CASE("places are marked, tiles are squares of their side and lie below everything") {
  const std::string text = script();
  CHECK(contains(text, "$places0_1 << EOD\n2 2\n1000000 -3\nEOD\n"));
  CHECK(contains(text, "$places1_0 << EOD\n4 1 1 1\n400 1 1 1\nEOD\n"));
  CHECK(contains(text, "$places1_0 using 1:2:3:4 with boxxyerror"));
  CHECK_FALSE(contains(text, "$places1_1"));  // nothing to draw
  const auto tile = text.find("$places2_1 using 1:2:3:4");
  const auto outline = text.rfind("$outlines using");
  const auto object = text.find("$places2_0 using 1:2 with points");
  REQUIRE(tile != std::string::npos);
  REQUIRE(object != std::string::npos);
  CHECK(tile < outline);
  CHECK(outline < object);
}

TEST_CASE("keys stand beside samples of their marks") {
  const std::string text = script();
  CHECK(count(text, gnuplot_string("truth")) == 1);
  CHECK(count(text, gnuplot_string("tile")) == 1);
  CHECK(contains(text, "$key0 using 1:2 with points pt 3"));
  CHECK(contains(text, "$key1 using 1:2:3:4 with boxxyerror"));
}

TEST_CASE("a floor plan is drawn in all three formats, whatever lies outside of its window") {
  const tests::ScratchFolder folder;
  for (const char* name : {"a.svg", "a.pdf", "a.png"}) draw(sample_plan(), folder / name);
  const auto text_of = [&](const char* name) {
    std::ifstream in(folder / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string svg = text_of("a.svg");
  for (const char* piece : {"it's a floor", "first", "second", "third", "truth", "note"}) {
    INFO(piece);
    CHECK(contains(svg, piece));
  }
  CHECK(text_of("a.png").starts_with("\x89PNG"));
  CHECK(text_of("a.pdf").starts_with("%PDF"));
  FloorPlan bare = sample_plan();
  bare.keys.clear();
  bare.panels.resize(1);
  bare.panels[0].places.clear();
  draw(bare, folder / "bare.svg");
  CHECK(contains(text_of("bare.svg"), "first"));
  CHECK_THROWS_AS(draw(sample_plan(), folder / "a.jpg"), core::InputError);
  bare.panels.clear();
  CHECK_THROWS_AS(draw(bare, folder / "none.svg"), std::invalid_argument);
}
