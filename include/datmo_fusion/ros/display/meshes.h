// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo {

/// Thrown for an invalid mesh file: file, line, what was expected.
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct MeshTriangle {
  /// Counterclockwise seen from outside.
  std::array<Eigen::Vector3f, 3> corners;

  /// None: paint, which has the color of what the mesh represents.
  std::optional<std_msgs::ColorRGBA> color;
};

/// Surface in a unit box on the ground: x forward and y left from -0.5 to 0.5, z up from 0 to 1.
using Mesh = std::vector<MeshTriangle>;

/// By the marker's mesh_resource.
using Meshes = std::map<std::string, Mesh>;

/// Reads a Wavefront obj file and its materials (mtllib, in the same folder): corners (v), convex
/// faces (f), and the diffuse color (Kd) of their material (usemtl), except that of the material
/// `paint`. Ignores everything else. Throws MeshError.
Mesh readMesh(const std::string& file);

/// Reads the meshes of all classes, from the `meshes` folder of the package at `package_path`.
/// Throws MeshError.
Meshes readClassMeshes(const std::string& package_path);

/// The mesh of a class, `package://datmo_fusion/meshes/...`; empty if the class has none.
std::string meshResourceOf(ObjectClass object_class);

/// The host as a mesh in its own colors, which moves with the frame of the scan. Needs no
/// transform but that of this frame.
visualization_msgs::Marker hostMesh(const std_msgs::Header& scan,
                                    const VehicleBodyOptions& options);

}  // namespace datmo
