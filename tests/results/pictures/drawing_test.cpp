#include "results/pictures/drawing.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "results/pictures/drawing_layout.hpp"
#include "results/pictures/drawing_script.hpp"
#include "results/pictures/gnuplot.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;
using tests::contains;
namespace fs = std::filesystem;

/// A window of 10 x 10 with a path that stays, one that leaves, two places with texts, and contours.
Drawing sample_drawing() {
  Drawing drawing;
  drawing.title = "it's a scene";
  drawing.x_label = "x [m]";
  drawing.y_label = "y [m]";
  drawing.window = {{0.0, 10.0}, {0.0, 10.0}};
  drawing.paths.push_back({"stays", "converged", {{1, 1}, {5, 5}, {6, 5}}, true});
  drawing.paths.push_back({"leaves", "diverged", {{1, 1}, {5, 2}, {15, 2}, {1e5, 2}}, false});
  drawing.places.push_back({"object", DrawnMark::Dot, {{2, 8}, {2.1, 8}}, {"1", "2"}, {}});
  drawing.places.push_back({"minimum", DrawnMark::Diamond, {{6, 5}}, {}, {0}});
  drawing.contours = {"residuals", {{0, 1, 2}, {1, 2, 3}, {2, 3, std::nan("")}}, {0.5, 1.5}};
  drawing.footnote = "note";
  return drawing;
}

TEST_CASE("a window is widened to the proportions of a picture, about its middle") {
  const DrawingWindow tall = fitted({{0.0, 1.0}, {0.0, 11.0}});
  CHECK(tall.x.low == Approx(-4.5));
  CHECK(tall.x.high == Approx(5.5));
  CHECK(tall.y.high == Approx(11.0));
  const DrawingWindow flat = fitted({{0.0, 10.0}, {1.0, 1.0}});
  CHECK(flat.y.low == Approx(-1.5));
  CHECK(flat.y.high == Approx(3.5));
}

TEST_CASE("a path is cut off where it leaves the window") {
  const Drawing d = sample_drawing();
  const VisiblePath stays = visible(d.paths[0], d.window);
  REQUIRE(stays.pieces.size() == 1);
  CHECK(stays.pieces[0].size() == 3);
  CHECK(stays.marks.size() == 2);
  CHECK(stays.end);
  CHECK_FALSE(stays.arrow);
  const VisiblePath leaves = visible(d.paths[1], d.window);
  REQUIRE(leaves.pieces.size() == 1);
  CHECK(leaves.pieces[0].back().x == Approx(10.0));
  CHECK(leaves.pieces[0].back().y == Approx(2.0));
  CHECK_FALSE(leaves.end);
  REQUIRE(leaves.arrow);
  CHECK(leaves.arrow->from.x == 5.0);
  CHECK(leaves.arrow->to.x == Approx(10.0));
}

TEST_CASE("a path that comes back, crosses or never enters is drawn as far as it is seen") {
  const DrawingWindow window{{0.0, 10.0}, {0.0, 10.0}};
  const VisiblePath back = visible({"", "", {{5, 5}, {15, 5}, {5, 6}}, true}, window);
  CHECK(back.pieces.size() == 2);
  CHECK(back.end);
  CHECK_FALSE(back.arrow);
  const VisiblePath across = visible({"", "", {{-5, 5}, {15, 5}}, true}, window);
  REQUIRE(across.pieces.size() == 1);
  CHECK(across.pieces[0][0].x == Approx(0.0));
  CHECK(across.pieces[0][1].x == Approx(10.0));
  const VisiblePath outside = visible({"", "", {{-5, 20}, {15, 20}}, true}, window);
  CHECK(outside.pieces.empty());
  CHECK_FALSE(outside.arrow);
  CHECK(visible({"", "", {}, true}, window).pieces.empty());
  CHECK(visible({"", "", {{5, 5}, {5, 5}}, true}, window).end);
}

TEST_CASE("both axes of a picture have one scale") {
  const DrawingLayout layout = drawing_layout(sample_drawing());
  CHECK(layout.bottom - layout.top == Approx(layout.right - layout.left));
}

TEST_CASE("texts stand beside their points without covering each other") {
  const DrawingLayout layout = drawing_layout(sample_drawing());
  REQUIRE(layout.texts.size() == 2);
  const PlacedText& first = layout.texts[0];
  const PlacedText& second = layout.texts[1];
  CHECK((std::fabs(first.x - second.x) >= small_character || std::fabs(first.y - second.y) >= 2.4));
  // Neither covers the points, which are 1 mm apart.
  const double x = layout.left + 0.2 * (layout.right - layout.left);
  const double y = layout.bottom - 0.8 * (layout.bottom - layout.top);
  for (const PlacedText& text : layout.texts) CHECK(std::hypot(text.x - x, text.y - y) > 1.2);
}

TEST_CASE("the script of a picture holds its lines, marks, contours and texts") {
  const std::string script = drawing_script(sample_drawing(), FigureFormat::Svg, "out.svg");
  CHECK(contains(script, "set output " + gnuplot_string("out.svg")));
  for (const char* text : {"it's a scene", "stays: converged", "minimum"})
    CHECK(contains(script, gnuplot_string(text)));
  const std::string outside = gnuplot_string("leaves ends outside the picture, at (1e+05, 2)");
  CHECK(contains(script, outside.substr(1, outside.size() - 2)));  // a part of the footnote
  CHECK(contains(script, "set cntrparam levels discrete 0.5,1.5"));
  CHECK(contains(script, "10 10 NaN"));
  CHECK(contains(script, "set xrange [0:10]\nset yrange [0:10]"));
  CHECK(contains(script, "$path0_line << EOD\n1 1\n5 5\n6 5\n"));
  CHECK(contains(script, "$path1_arrow << EOD\n5 2 5 0\n"));
  // The end of the first is filled, the diamond has its colour.
  CHECK(contains(script, "$path0_end using 1:2 with points pt 7 ps 0.9 lw 1.2 lc rgb '#0072b2'"));
  CHECK(contains(script, "$place1_0 using 1:2 with points pt 12 ps 1.6 lw 1 lc rgb '#0072b2'"));
  Drawing plain = sample_drawing();
  plain.contours.reset();
  CHECK_FALSE(contains(drawing_script(plain, FigureFormat::Svg, "out.svg"), "contour"));
}

TEST_CASE("a picture is drawn in all three formats, an empty one too") {
  const tests::ScratchFolder folder;
  Drawing empty;
  for (const char* name : {"a.svg", "a.pdf", "a.png"}) {
    draw(sample_drawing(), folder / name);
    draw(empty, folder / (std::string("empty_") + name));
  }
  std::ifstream in(folder / "a.svg");
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  CHECK(contains(svg, "it's a scene"));
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 6);
  CHECK_THROWS_AS(draw(sample_drawing(), folder / "a.jpg"), core::InputError);
}

}  // namespace
