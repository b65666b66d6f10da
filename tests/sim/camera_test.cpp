#include "sim/camera.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "sim/detector.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hall.hpp"

using namespace ridgeloc;
using tests::hall;
using tests::object_at;
using tests::pose;

namespace {

struct Picture {
  std::vector<sim::View> views;
  double image_distance_mm = 0.0;
};

Picture picture_of(const std::vector<sim::MapObject>& objects, const sim::Camera& camera = {},
                   const sim::CameraPose& from = pose()) {
  Picture picture;
  sim::take_photo(hall(objects), camera, from, picture.views, picture.image_distance_mm);
  return picture;
}

/// The box of the only object.
sim::Box box_of(const sim::MapObject& object, const sim::CameraPose& from) {
  const Picture picture = picture_of({object}, {}, from);
  REQUIRE(picture.views.size() == 1);
  return picture.views[0].box;
}

bool is_seen(const sim::MapObject& object, const sim::Camera& camera = {}) {
  return !picture_of({object}, camera).views.empty();
}

/// Of products and quotients of a few numbers, and of sums that do not cancel.
constexpr double rounding = 1e-13;

}  // namespace

TEST_CASE("the camera is that of the iPhone 6") {
  const sim::Camera camera;
  const double per_radian = camera.focal_length_mm * camera.pixels_per_mm();
  CHECK(per_radian == Approx(2767.0).epsilon(2e-4));
  const auto field_deg = [&](double px) { return 2.0 * std::atan(0.5 * px / per_radian) * 180.0 / std::numbers::pi; };
  CHECK(std::fabs(field_deg(camera.width_px) - 61.1) < 0.05);  // as printed to a tenth
  CHECK(std::fabs(field_deg(camera.height_px) - 47.7) < 0.05);
}

TEST_CASE("without tilt boxes are h v / u high and ranges follow from them exactly") {
  const sim::Camera camera;
  std::size_t seen = 0;
  for (int i = 0; i < 200; ++i) {
    const double heading = i / 200.0;
    const double angle = 2.0 * std::numbers::pi * (heading + 0.05 * std::sin(i));
    const double distance = 1.5 + 0.05 * i;
    const auto object = object_at(distance * std::cos(angle), distance * std::sin(angle), 1.5 + 0.1 * std::cos(7 * i),
                                  0.3, 0.2 + 0.001 * i);
    const Picture picture = picture_of({object}, camera, pose(heading));
    for (const sim::View& view : picture.views) {
      ++seen;
      const double v = picture.image_distance_mm;
      CHECK(view.box.height_px ==
            Approx(object.height_m * v * camera.pixels_per_mm() / view.depth_m).epsilon(rounding));
      CHECK(view.range_m == Approx(std::hypot(distance, object.centre_m[2] - 1.5)).epsilon(rounding));
      const auto measured = sim::pseudorange(camera, view.box, object.height_m);
      const double l_mm = std::hypot(view.box.x_px, view.box.y_px) / camera.pixels_per_mm();
      CHECK(measured.rho == Approx(measured.alpha * l_mm * l_mm).epsilon(rounding));
      CHECK(measured.range_m(v) == Approx(view.range_m).epsilon(rounding));
    }
  }
  CHECK(seen > 150);
}

TEST_CASE("headings turn from x to y, and the picture from left to right and down") {
  const auto ahead = object_at(5, 0, 1.5);
  CHECK(std::fabs(box_of(ahead, pose()).x_px) < 1e-9);
  CHECK(std::fabs(box_of(ahead, pose()).y_px) < 1e-9);
  CHECK(box_of(object_at(5, 1, 1.5), pose()).x_px < 0.0);
  CHECK(box_of(object_at(5, -1, 1.5), pose()).x_px > 0.0);
  CHECK(box_of(object_at(5, 0, 2.0), pose()).y_px < 0.0);
  CHECK(box_of(object_at(5, 0, 1.0), pose()).y_px > 0.0);
  CHECK(std::fabs(box_of(object_at(0, 5, 1.5), pose(0.25)).x_px) < 1e-9);
  CHECK(box_of(ahead, pose(0.02)).x_px > 0.0);  // turned to the left
}

TEST_CASE("pitch up moves objects down, by its angle") {
  const double angle = 0.04 * std::numbers::pi;
  const sim::Box box = box_of(object_at(5, 0, 1.5), pose(0.0, 0.02));
  const sim::Camera camera;
  const double scale = camera.image_distance_mm(5.0 * std::cos(angle)) * camera.pixels_per_mm();
  const double half = std::atan(0.25 / 5.0);  // of the object's height, as an angle
  CHECK(box.y_px == Approx(0.5 * scale * (std::tan(angle + half) + std::tan(angle - half))).epsilon(rounding));
  CHECK(std::fabs(box.x_px) < 1e-9);
}

TEST_CASE("roll to the right lifts what is to the right and sinks what is to the left") {
  const sim::CameraPose rolled = pose(0.0, 0.0, 0.02);
  CHECK(box_of(object_at(5, -1, 1.5), rolled).y_px < -50.0);
  CHECK(box_of(object_at(5, 1, 1.5), rolled).y_px > 50.0);
  CHECK(box_of(object_at(5, 0, 2.5), rolled).x_px < -50.0);  // and tilts what is above to the left
  CHECK(std::fabs(box_of(object_at(5, 0, 1.5), rolled).x_px) < 1e-9);
}

TEST_CASE("objects are seen whole or not at all") {
  CHECK(is_seen(object_at(5, 0, 1.5)));
  CHECK_FALSE(is_seen(object_at(-5, 0, 1.5)));
  CHECK_FALSE(is_seen(object_at(0.49, 0, 1.5, 0.05, 0.05)));
  CHECK(is_seen(object_at(0.51, 0, 1.5, 0.05, 0.05)));
  // Half a picture is 0.59 and 0.44 of the depth wide and high.
  CHECK(is_seen(object_at(5, 2.6, 1.5)));
  CHECK_FALSE(is_seen(object_at(5, 2.8, 1.5)));
  CHECK_FALSE(is_seen(object_at(5, -2.8, 1.5)));
  CHECK(is_seen(object_at(5, 0, 3.4)));
  CHECK_FALSE(is_seen(object_at(5, 0, 3.6)));
  CHECK_FALSE(is_seen(object_at(5, 0, -0.6)));
}

TEST_CASE("objects too far away or too low in the picture are not seen") {
  sim::Camera camera;
  camera.farthest_m = 8.0;
  CHECK(is_seen(object_at(7.99, 0, 1.5), camera));
  CHECK_FALSE(is_seen(object_at(8.01, 0, 1.5), camera));
  CHECK_FALSE(is_seen(object_at(7.9, 1.5, 1.5), camera));  // as far as it is, not as deep
  // 2767 px of the focal length make 100 px of 0.5 m at 13.8 m, focusing but a little more.
  camera = {};
  camera.farthest_m = 100.0;
  camera.smallest_box_px = 100.0;
  CHECK(is_seen(object_at(13.8, 0, 1.5), camera));
  CHECK_FALSE(is_seen(object_at(13.9, 0, 1.5), camera));
  CHECK(is_seen(object_at(13.9, 0, 1.5, 0.5, 0.6), camera));
}

TEST_CASE("a photo shows the objects in their order and none behind walls") {
  sim::BuildingMap map =
      hall({object_at(5, 0, 1.5), object_at(6, 1, 1.5), object_at(-5, 0, 1.5), object_at(4, -1, 1.5)});
  Picture picture;
  sim::take_photo(map, {}, pose(), picture.views, picture.image_distance_mm);
  const auto numbers = [&] {
    std::vector<std::size_t> list;
    for (const sim::View& view : picture.views) list.push_back(view.object);
    return list;
  };
  CHECK(numbers() == std::vector<std::size_t>{0, 1, 3});
  map.walls = {{{4.5, -0.2}, {4.5, 5.0}}};
  sim::take_photo(map, {}, pose(), picture.views, picture.image_distance_mm);
  CHECK(numbers() == std::vector<std::size_t>{3});
}

TEST_CASE("the lens is focused on what is nearest to the axis") {
  const sim::Camera camera;
  const auto distance_for = [&](double u_mm) { return 4.15 * u_mm / (u_mm - 4.15); };
  CHECK(picture_of({object_at(3, 1, 1.5), object_at(8, 0.2, 1.5)}).image_distance_mm ==
        Approx(distance_for(8000)).epsilon(rounding));
  CHECK(picture_of({object_at(3, 0, 1.5), object_at(8, 0.2, 1.5)}).image_distance_mm ==
        Approx(distance_for(3000)).epsilon(rounding));
  CHECK(picture_of({}).image_distance_mm == camera.focal_length_mm);
  CHECK(camera.image_distance_mm(0.001) == Approx(2.0 * camera.focal_length_mm).epsilon(rounding));
}

TEST_CASE("focusing on something near pushes what stands at the edge out of the picture") {
  // Its left edge is 0.998 of half a picture away at the focal length. Focusing at 1 m enlarges by 0.0042, at 10 m by
  // 0.0004.
  const double edge = 0.998 * 0.5 * 3264.0 / (4.15 / 0.0015) * 5.0;
  const auto at_edge = object_at(5, edge - 0.25, 1.5);
  CHECK(picture_of({at_edge, object_at(10, 0, 1.5)}).views.size() == 2);
  CHECK(picture_of({at_edge, object_at(1, 0, 1.5, 0.1, 0.1)}).views.size() == 1);
}

TEST_CASE("digital zoom magnifies the middle of the picture and changes no range") {
  sim::Camera camera;
  const std::vector<sim::MapObject> objects = {object_at(6, 0.4, 1.5), object_at(6, 2.5, 1.5)};
  const Picture wide = picture_of(objects, camera);
  camera.zoom = 2.0;
  const Picture zoomed = picture_of(objects, camera);
  REQUIRE(wide.views.size() == 2);
  REQUIRE(zoomed.views.size() == 1);
  CHECK(zoomed.views[0].box.x_px == Approx(2.0 * wide.views[0].box.x_px).epsilon(rounding));
  CHECK(zoomed.views[0].box.height_px == Approx(2.0 * wide.views[0].box.height_px).epsilon(rounding));
  CHECK(sim::pseudorange(camera, zoomed.views[0].box, 0.5).range_m(zoomed.image_distance_mm) ==
        Approx(zoomed.views[0].range_m).epsilon(rounding));
}
