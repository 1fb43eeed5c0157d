// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/meshes.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "marker_parts.h"

namespace datmo {

namespace {

using Materials = std::map<std::string, std_msgs::ColorRGBA>;

constexpr char kPackage[] = "package://datmo_fusion/";
constexpr char kPaint[] = "paint";

/// Lines of a file of keywords, each with its arguments.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& file) : file_(file), stream_(file) {
    if (!stream_) {
      throw MeshError(file_.string() + ": cannot be read");
    }
  }

  /// Proceeds to the next line and its keyword; false at the end of the file.
  bool next(std::string& keyword) {
    std::string line;
    if (!std::getline(stream_, line)) {
      return false;
    }
    ++number_;
    words_ = std::istringstream(line);
    keyword.clear();
    words_ >> keyword;
    return true;
  }

  /// The next argument of the line; false if there is none.
  template <typename Value>
  bool read(Value& value) {
    return static_cast<bool>(words_ >> value);
  }

  template <typename Value>
  Value expect(const std::string& what) {
    Value value{};
    if (!read(value)) {
      fail("expected " + what);
    }
    return value;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw MeshError(file_.string() + ":" + std::to_string(number_) + ": " + problem);
  }

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::istringstream words_;
  std::size_t number_ = 0;
};

Materials readMaterials(const std::filesystem::path& file) {
  LineReader reader(file);
  Materials materials;
  std::string material;
  for (std::string keyword; reader.next(keyword);) {
    if (keyword == "newmtl") {
      material = reader.expect<std::string>("the name of a material");
      materials[material] = color(1.0F, 1.0F, 1.0F);
    } else if (keyword == "Kd") {
      const auto red = reader.expect<float>("three numbers");
      const auto green = reader.expect<float>("three numbers");
      const auto blue = reader.expect<float>("three numbers");
      materials[material] = color(red, green, blue);
    }
  }
  return materials;
}

class MeshReader {
 public:
  explicit MeshReader(const std::filesystem::path& file)
      : folder_(file.parent_path()), reader_(file) {}

  Mesh read() {
    for (std::string keyword; reader_.next(keyword);) {
      if (keyword == "v") {
        const auto x = reader_.expect<float>("three coordinates");
        const auto y = reader_.expect<float>("three coordinates");
        corners_.emplace_back(x, y, reader_.expect<float>("three coordinates"));
      } else if (keyword == "f") {
        addFace();
      } else if (keyword == "mtllib") {
        materials_ = readMaterials(folder_ / reader_.expect<std::string>("the name of a file"));
      } else if (keyword == "usemtl") {
        setMaterial(reader_.expect<std::string>("the name of a material"));
      }
    }
    return std::move(mesh_);
  }

 private:
  void setMaterial(const std::string& name) {
    color_.reset();
    if (name == kPaint) {
      return;
    }
    const auto found = materials_.find(name);
    if (found == materials_.end()) {
      reader_.fail("'" + name + "' is not a material: expected a name from mtllib");
    }
    color_ = found->second;
  }

  /// Splits a face into triangles. A corner is `index`, or `index/...`.
  void addFace() {
    std::vector<Eigen::Vector3f> face;
    for (std::string word; reader_.read(word);) {
      std::istringstream digits(word);
      std::size_t index = 0;
      if (!(digits >> index) || index < 1 || index > corners_.size()) {
        reader_.fail("'" + word + "' is not a corner: expected 1 to " +
                     std::to_string(corners_.size()));
      }
      face.push_back(corners_[index - 1]);
    }
    if (face.size() < 3) {
      reader_.fail("a face of " + std::to_string(face.size()) + " corners: expected 3 or more");
    }
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      mesh_.push_back({{face[0], face[i], face[i + 1]}, color_});
    }
  }

  std::filesystem::path folder_;
  LineReader reader_;
  Materials materials_;
  std::vector<Eigen::Vector3f> corners_;
  std::optional<std_msgs::ColorRGBA> color_;
  Mesh mesh_;
};

/// The mesh's path in the package; empty: none.
std::string meshFileOf(ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::kVehicle:
    case ObjectClass::kPedestrian:
    case ObjectClass::kCyclist:
      return std::string("meshes/") + nameOf(object_class) + ".obj";
    case ObjectClass::kPole:
    case ObjectClass::kUnknown:
      break;
  }
  return "";
}

}  // namespace

Mesh readMesh(const std::string& file) { return MeshReader(file).read(); }

Meshes readClassMeshes(const std::string& package_path) {
  Meshes meshes;
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    const std::string file = meshFileOf(static_cast<ObjectClass>(i));
    if (!file.empty()) {
      meshes[kPackage + file] = readMesh(package_path + "/" + file);
    }
  }
  return meshes;
}

std::string meshResourceOf(ObjectClass object_class) {
  const std::string file = meshFileOf(object_class);
  return file.empty() ? "" : kPackage + file;
}

visualization_msgs::Marker hostMesh(const std_msgs::Header& scan,
                                    const VehicleBodyOptions& options) {
  auto marker = makeMarker(scan, "host vehicle", visualization_msgs::Marker::MESH_RESOURCE);
  marker.header.stamp = ros::Time();  // with frame_locked: follows the latest position of its frame
  marker.frame_locked = true;
  marker.mesh_resource = meshResourceOf(ObjectClass::kVehicle);
  marker.mesh_use_embedded_materials = true;  // with a color of zeros: no tint
  marker.pose.position.x = 0.5 * options.length - options.rear_overhang;
  marker.scale.x = options.length;
  marker.scale.y = options.width;
  marker.scale.z = options.height;
  return marker;
}

}  // namespace datmo
