// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/drawing.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace datmo::drawing_test {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

Marker makeShape(int type, double alpha = 1.0) {
  Marker marker;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = 4.0;
  marker.scale.y = 2.0;
  marker.scale.z = 1.0;
  marker.color.r = 1.0F;
  marker.color.a = static_cast<float>(alpha);
  return marker;
}

geometry_msgs::Point at(double x, double y, double z = 0.0) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = z;
  return point;
}

Drawing drawn(const Marker& marker) {
  MarkerArray markers;
  markers.markers = {marker};
  return drawingOf(markers);
}

Eigen::Vector3f largest(const std::vector<DrawnVertex>& vertices) {
  Eigen::Vector3f most = vertices.at(0).position;
  for (const DrawnVertex& vertex : vertices) {
    most = most.cwiseMax(vertex.position);
  }
  return most;
}

/// Area of all triangles, m^2.
float areaOf(const std::vector<DrawnVertex>& vertices) {
  float area = 0.0F;
  for (std::size_t i = 0; i + 2 < vertices.size(); i += 3) {
    const Eigen::Vector3f& a = vertices[i].position;
    area += 0.5F * (vertices[i + 1].position - a).cross(vertices[i + 2].position - a).norm();
  }
  return area;
}

TEST(Drawing, ABoxIsTwelveTrianglesTurnedAndMovedWithIt) {
  Marker box = makeShape(Marker::CUBE);
  box.pose.position = at(10.0, 5.0, 0.5);
  box.pose.orientation.z = std::sqrt(0.5);  // a quarter turn
  box.pose.orientation.w = std::sqrt(0.5);
  const Drawing drawing = drawn(box);
  ASSERT_EQ(drawing.solid.size(), 36U);
  EXPECT_TRUE(drawing.translucent.empty());
  EXPECT_LT((largest(drawing.solid) - Eigen::Vector3f(11.0F, 7.0F, 1.0F)).norm(), 1e-5F);
  EXPECT_NEAR(areaOf(drawing.solid), 2.0F * (4.0F * 2.0F + 4.0F * 1.0F + 2.0F * 1.0F), 1e-4F);
}

TEST(Drawing, TheTopIsBrighterThanTheSides) {
  const Drawing drawing = drawn(makeShape(Marker::CUBE));
  EXPECT_GT(drawing.solid[0].color.r, drawing.solid[35].color.r);
  EXPECT_LE(drawing.solid[0].color.r, 1.0F);
}

TEST(Drawing, TransparentShapesAreASeparateList) {
  const Drawing drawing = drawn(makeShape(Marker::CUBE, 0.3));
  EXPECT_TRUE(drawing.solid.empty());
  EXPECT_EQ(drawing.translucent.size(), 36U);
}

TEST(Drawing, RoundShapesHaveNearlyTheirSurface) {
  Marker sphere = makeShape(Marker::SPHERE);
  sphere.scale.x = sphere.scale.y = sphere.scale.z = 2.0;
  EXPECT_NEAR(areaOf(drawn(sphere).solid), 4.0F * 3.14F, 0.7F);
  Marker cylinder = makeShape(Marker::CYLINDER);
  cylinder.scale.x = cylinder.scale.y = 2.0;
  EXPECT_NEAR(areaOf(drawn(cylinder).solid), 2.0F * 3.14F + 2.0F * 3.14F, 0.4F);
}

TEST(Drawing, ALineIsARibbonOfItsWidthAcrossItsCorners) {
  Marker line = makeShape(Marker::LINE_STRIP);
  line.scale.x = 0.2;
  line.points = {at(0.0, 0.0), at(10.0, 0.0), at(10.0, 10.0)};
  const Drawing drawing = drawn(line);
  EXPECT_EQ(drawing.solid.size(), 2U * 6U);
  EXPECT_NEAR(areaOf(drawing.solid), 20.0F * 0.2F, 1e-3F);
  EXPECT_NEAR(largest(drawing.solid).x(), 10.1F, 1e-5F) << "the corner is whole";
}

TEST(Drawing, ATurnOnTheSpotHasNoSpike) {
  Marker line = makeShape(Marker::LINE_STRIP);
  line.scale.x = 0.2;
  line.points = {at(0.0, 0.0), at(10.0, 0.0), at(0.0, 0.01)};
  EXPECT_LT(largest(drawn(line).solid).x(), 10.5F);
}

TEST(Drawing, AnArrowEndsAtItsPoint) {
  Marker arrow = makeShape(Marker::ARROW);
  arrow.scale.x = 0.2;
  arrow.scale.y = 0.6;
  arrow.points = {at(0.0, 0.0, 1.0), at(3.0, 0.0, 1.0)};
  const Drawing drawing = drawn(arrow);
  EXPECT_EQ(drawing.solid.size(), 9U);
  EXPECT_NEAR(largest(drawing.solid).x(), 3.0F, 1e-6F);
  EXPECT_NEAR(largest(drawing.solid).y(), 0.3F, 1e-6F);
}

TEST(Drawing, NothingMovesWithoutLength) {
  Marker arrow = makeShape(Marker::ARROW);
  arrow.points = {at(1.0, 1.0), at(1.0, 1.0)};
  EXPECT_TRUE(drawn(arrow).solid.empty());
  for (const DrawnVertex& vertex : drawn(makeShape(Marker::LINE_STRIP)).solid) {
    EXPECT_TRUE(vertex.position.allFinite());
  }
}

TEST(Drawing, TrianglesKeepTheColorsOfTheirCorners) {
  Marker triangles = makeShape(Marker::TRIANGLE_LIST);
  triangles.points = {at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)};
  triangles.colors.resize(3);
  triangles.colors[1].g = 1.0F;
  const Drawing drawing = drawn(triangles);
  ASSERT_EQ(drawing.translucent.size(), 3U);
  EXPECT_GT(drawing.translucent[1].color.g, drawing.translucent[0].color.g);
}

TEST(Drawing, TextsAreLabels) {
  Marker text = makeShape(Marker::TEXT_VIEW_FACING);
  text.text = "#7";
  const Drawing drawing = drawn(text);
  ASSERT_EQ(drawing.labels.size(), 1U);
  EXPECT_EQ(drawing.labels[0].text, "#7");
  EXPECT_FLOAT_EQ(drawing.labels[0].height, 1.0F);
}

TEST(Drawing, NonFiniteShapesAreLeftOut) {
  Marker box = makeShape(Marker::CUBE);
  box.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  Marker line = makeShape(Marker::LINE_STRIP);
  line.points = {at(0.0, 0.0), at(std::numeric_limits<double>::infinity(), 0.0)};
  for (const Marker& marker : {box, line}) {
    const Drawing drawing = drawn(marker);
    EXPECT_TRUE(drawing.solid.empty());
    EXPECT_EQ(drawing.left_out, 1U);
  }
  Marker gone = makeShape(Marker::CUBE);
  gone.action = Marker::DELETE;
  EXPECT_TRUE(drawn(gone).solid.empty());
  EXPECT_EQ(drawn(gone).left_out, 0U);
}

}  // namespace
}  // namespace datmo::drawing_test
