// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/meshes.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/display/drawing.h"
#include "datmo_fusion/ros/display/marker_colors.h"
#include "datmo_fusion/ros/display/track_style.h"

namespace datmo::meshes_test {
namespace {

using testing::HasSubstr;
using visualization_msgs::Marker;

/// Six times the enclosed volume; negative: triangles are seen from inside.
float volumeOf(const Mesh& mesh) {
  float volume = 0.0F;
  for (const MeshTriangle& triangle : mesh) {
    const auto& [a, b, c] = triangle.corners;
    volume += a.dot(b.cross(c));
  }
  return volume;
}

TEST(Meshes, EachFillsTheUnitBoxAndIsSeenFromOutside) {
  const Meshes meshes = readClassMeshes(DATMO_FUSION_SOURCE_DIR);
  EXPECT_EQ(meshes.size(), 3U);
  for (const auto& [name, mesh] : meshes) {
    Eigen::AlignedBox3f box;
    for (const MeshTriangle& triangle : mesh) {
      for (const Eigen::Vector3f& corner : triangle.corners) {
        box.extend(corner);
      }
    }
    EXPECT_LT((box.min() - Eigen::Vector3f(-0.5F, -0.5F, 0.0F)).norm(), 1e-6F) << name;
    EXPECT_LT((box.max() - Eigen::Vector3f(0.5F, 0.5F, 1.0F)).norm(), 1e-6F) << name;
    EXPECT_GT(volumeOf(mesh), 0.0F) << name;
    EXPECT_LT(mesh.size(), 500U) << name << ": 200 of them are drawn at once";
  }
}

TEST(Meshes, OnlyRoadUsersHaveOne) {
  EXPECT_EQ(meshResourceOf(ObjectClass::kVehicle), "package://datmo_fusion/meshes/vehicle.obj");
  EXPECT_EQ(meshResourceOf(ObjectClass::kCyclist), "package://datmo_fusion/meshes/cyclist.obj");
  EXPECT_EQ(meshResourceOf(ObjectClass::kPole), "");
  EXPECT_EQ(meshResourceOf(ObjectClass::kUnknown), "");
}

TEST(Meshes, ThePaintOfTheFilesIsTheHosts) {
  std::ifstream file(DATMO_FUSION_SOURCE_DIR "/meshes/road_users.mtl");
  std::stringstream text;
  text << file.rdbuf();
  const auto host = colorOfOwnVehicle();
  std::ostringstream expected;
  expected << "newmtl paint\nKd " << host.r << ' ' << host.g << ' ' << host.b << '\n';
  EXPECT_THAT(text.str(), HasSubstr(expected.str()));
}

TEST(Meshes, TheHostHasTheConfiguredSizeAndMovesWithItsFrame) {
  std_msgs::Header scan;
  scan.frame_id = "base_link";
  scan.stamp = ros::Time(5.0);
  const Marker host = hostMesh(scan, {4.0, 1.8, 1.0, 1.5});
  EXPECT_EQ(host.mesh_resource, meshResourceOf(ObjectClass::kVehicle));
  EXPECT_TRUE(host.mesh_use_embedded_materials);
  EXPECT_EQ(host.color.a, 0.0F) << "rviz tints a mesh otherwise";
  EXPECT_TRUE(host.frame_locked);
  EXPECT_EQ(host.header.frame_id, "base_link");
  EXPECT_TRUE(host.header.stamp.isZero()) << "tf may not know the scan's time yet";
  EXPECT_DOUBLE_EQ(host.pose.position.x, 1.0);
  EXPECT_DOUBLE_EQ(host.scale.x, 4.0);
  EXPECT_DOUBLE_EQ(host.scale.y, 1.8);
  EXPECT_DOUBLE_EQ(host.scale.z, 1.5);
}

TrackArray trackOf(std::uint8_t classification) {
  TrackArray tracks;
  tracks.tracks.resize(1);
  TrackMessage& track = tracks.tracks[0];
  track.classification = classification;
  track.existence_probability = 1.0F;
  track.moving = true;
  track.pose.position.x = 10.0;
  track.pose.orientation.z = std::sqrt(0.5);  // a quarter turn to the left
  track.pose.orientation.w = std::sqrt(0.5);
  track.size.x = 4.0;
  track.size.y = 2.0;
  track.size.z = 1.6;
  return tracks;
}

Drawing drawnMesh(const TrackArray& tracks) {
  TrackStyle style;
  style.shape = TrackShape::kMesh;
  visualization_msgs::MarkerArray bodies;
  for (const Marker& marker : markersOf(tracks, style).markers) {
    if (marker.ns == "track bodies" || marker.ns == "track heads") {
      bodies.markers.push_back(marker);
    }
  }
  return drawingOf(bodies, readClassMeshes(DATMO_FUSION_SOURCE_DIR));
}

TEST(Meshes, ATracksMeshHasItsSizeAndHeading) {
  const Drawing drawing = drawnMesh(trackOf(ObjectMessage::CLASS_VEHICLE));
  Eigen::AlignedBox3f box;
  for (const DrawnVertex& vertex : drawing.solid) {
    box.extend(vertex.position);
  }
  EXPECT_LT((box.min() - Eigen::Vector3f(9.0F, -2.0F, 0.0F)).norm(), 1e-5F);
  EXPECT_LT((box.max() - Eigen::Vector3f(11.0F, 2.0F, 1.6F)).norm(), 1e-5F);
}

TEST(Meshes, ATracksPaintHasItsColorAndItsTiresHaveNot) {
  std::size_t blue = 0;
  std::size_t dark = 0;
  for (const DrawnVertex& vertex : drawnMesh(trackOf(ObjectMessage::CLASS_VEHICLE)).solid) {
    blue += vertex.color.b > 0.5F && vertex.color.r < 0.2F ? 1 : 0;
    dark += vertex.color.b < 0.1F ? 1 : 0;
  }
  EXPECT_GT(blue, 100U);
  EXPECT_GT(dark, 100U);
}

TEST(Meshes, UncertainTracksAreTranslucentWithoutTheirInside) {
  TrackArray tracks = trackOf(ObjectMessage::CLASS_PEDESTRIAN);
  const std::size_t all = drawnMesh(tracks).solid.size();
  tracks.tracks[0].existence_probability = 0.5F;
  const Drawing drawing = drawnMesh(tracks);
  EXPECT_TRUE(drawing.solid.empty());
  EXPECT_EQ(drawing.meshes.size(), all);
  for (const DrawnVertex& vertex : drawing.meshes) {
    EXPECT_NEAR(vertex.color.a, 0.5F, 0.01F);
  }
}

TEST(Meshes, PolesAndUnknownTracksKeepTheirShapes) {
  constexpr std::size_t kBoxVertices = 36;
  EXPECT_EQ(drawnMesh(trackOf(ObjectMessage::CLASS_UNKNOWN)).solid.size(), kBoxVertices);
  EXPECT_GT(drawnMesh(trackOf(ObjectMessage::CLASS_POLE)).solid.size(), kBoxVertices);
}

TEST(Meshes, AMarkerWhoseMeshIsNotReadIsOmitted) {
  Marker marker;
  marker.type = Marker::MESH_RESOURCE;
  marker.mesh_resource = "package://elsewhere/mesh.obj";
  visualization_msgs::MarkerArray markers;
  markers.markers = {marker};
  EXPECT_TRUE(drawingOf(markers).solid.empty());
}

/// What is wrong with a file of this content; empty: nothing.
std::string problemOf(const std::string& content) {
  const std::string file = testing::TempDir() + "mesh.obj";
  std::ofstream(file) << content;
  std::string problem;
  try {
    readMesh(file);
  } catch (const MeshError& error) {
    problem = error.what();
  }
  std::remove(file.c_str());
  return problem;
}

TEST(Meshes, AnInvalidFileIsNamedWithItsLine) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(problemOf(corners + "f 1/1/1 2//2 3\n"), "");
  EXPECT_THAT(problemOf("v 0 0\n"), HasSubstr("mesh.obj:1: expected three coordinates"));
  EXPECT_THAT(problemOf(corners + "f 1 2 4\n"),
              HasSubstr(":4: '4' is not a corner: expected 1 to 3"));
  EXPECT_THAT(problemOf(corners + "f 1 2 -1\n"), HasSubstr("'-1' is not a corner"));
  EXPECT_THAT(problemOf(corners + "f 1 2\n"), HasSubstr("a face of 2 corners: expected 3 or more"));
  EXPECT_THAT(problemOf("usemtl tin\n"), HasSubstr("'tin' is not a material"));
  EXPECT_THAT(problemOf("mtllib none.mtl\n"), HasSubstr("none.mtl: cannot be read"));
  EXPECT_THROW(readClassMeshes("/nowhere"), MeshError);
}

}  // namespace
}  // namespace datmo::meshes_test
