// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using Vector = Eigen::Vector3f;
using Vectors = std::vector<Vector>;

/// A shape with at least this opacity hides what is behind it.
constexpr float kOpaque = 0.85F;

/// Number of sides of round shapes, and of rings of a sphere.
constexpr int kSides = 16;
constexpr int kRings = 6;

/// Light from above, slightly from the front and the left: ambient share, and the direction to the
/// light.
constexpr float kAmbient = 0.62F;
const Vector kLight = Vector(0.36F, 0.48F, 0.8F);

/// Length of an arrow's head over its width, and its maximum share of the arrow.
constexpr float kHeadLength = 1.3F;
constexpr float kMaxHeadShare = 0.5F;

/// Maximum distance of a ribbon's corner from its center line, in half widths: sharp turns have no
/// spikes.
constexpr float kMaxMiter = 2.0F;

Vector pointOf(const geometry_msgs::Point& point) {
  return Eigen::Vector3d(point.x, point.y, point.z).cast<float>();
}

class Pencil {
 public:
  Pencil(const Marker& marker, Drawing& drawing) : marker_(marker), drawing_(drawing) {
    const auto& q = marker.pose.orientation;
    const Eigen::Quaternionf turn(static_cast<float>(q.w), static_cast<float>(q.x),
                                  static_cast<float>(q.y), static_cast<float>(q.z));
    if (turn.norm() > 0.0F) {
      turn_ = turn.normalized().toRotationMatrix();
    }
    origin_ = pointOf(marker.pose.position);
    scale_ = Vector(static_cast<float>(marker.scale.x), static_cast<float>(marker.scale.y),
                    static_cast<float>(marker.scale.z));
  }

  /// In the marker's frame.
  void triangle(const Vector& a, const Vector& b, const Vector& c,
                const std::array<std_msgs::ColorRGBA, 3>& colors) {
    const Vector normal = (turn_ * (b - a).cross(c - a)).normalized();
    const float light = kAmbient + (1.0F - kAmbient) * std::max(0.0F, normal.dot(kLight));
    std::vector<DrawnVertex>& list = listFor(colors[0].a);
    const std::array<const Vector*, 3> corners{&a, &b, &c};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      DrawnVertex vertex{origin_ + turn_ * *corners[i], colors[i]};
      vertex.color.r *= light;
      vertex.color.g *= light;
      vertex.color.b *= light;
      list.push_back(vertex);
    }
  }

  void triangle(const Vector& a, const Vector& b, const Vector& c) {
    triangle(a, b, c, {marker_.color, marker_.color, marker_.color});
  }

  void quad(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  /// Scales a point of a unit shape (size 1, centered at the origin) by the marker's scale.
  Vector scaled(float x, float y, float z) const { return scale_.cwiseProduct(Vector(x, y, z)); }

  const Vector& scale() const { return scale_; }

 private:
  std::vector<DrawnVertex>& listFor(float opacity) {
    if (opacity >= kOpaque) {
      return drawing_.solid;
    }
    return marker_.type == Marker::MESH_RESOURCE ? drawing_.meshes : drawing_.translucent;
  }

  const Marker& marker_;
  Drawing& drawing_;
  Eigen::Matrix3f turn_ = Eigen::Matrix3f::Identity();
  Vector origin_;
  Vector scale_;
};

void drawBox(Pencil& pencil) {
  const auto corner = [&](int x, int y, int z) {
    return pencil.scaled(static_cast<float>(x) - 0.5F, static_cast<float>(y) - 0.5F,
                         static_cast<float>(z) - 0.5F);
  };
  pencil.quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
  pencil.quad(corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0), corner(0, 0, 0));
  pencil.quad(corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
  pencil.quad(corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1));
  pencil.quad(corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1));
  pencil.quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
}

/// A point of the unit circle around the z axis, at a height.
Vector onCircle(const Pencil& pencil, int side, float share, float z) {
  const double angle = kTurn * side / kSides;
  return pencil.scaled(0.5F * share * static_cast<float>(std::cos(angle)),
                       0.5F * share * static_cast<float>(std::sin(angle)), z);
}

void drawCylinder(Pencil& pencil) {
  for (int i = 0; i < kSides; ++i) {
    const Vector low = onCircle(pencil, i, 1.0F, -0.5F);
    const Vector next_low = onCircle(pencil, i + 1, 1.0F, -0.5F);
    const Vector high = onCircle(pencil, i, 1.0F, 0.5F);
    const Vector next_high = onCircle(pencil, i + 1, 1.0F, 0.5F);
    pencil.quad(low, next_low, next_high, high);
    pencil.triangle(pencil.scaled(0.0F, 0.0F, 0.5F), high, next_high);
    pencil.triangle(pencil.scaled(0.0F, 0.0F, -0.5F), next_low, low);
  }
}

void drawSphere(Pencil& pencil) {
  const auto at = [&](int side, int ring) {
    const double polar = kPi * ring / kRings;  // from below
    return onCircle(pencil, side, static_cast<float>(std::sin(polar)),
                    -0.5F * static_cast<float>(std::cos(polar)));
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int i = 0; i < kSides; ++i) {
      pencil.quad(at(i, ring), at(i + 1, ring), at(i + 1, ring + 1), at(i, ring + 1));
    }
  }
}

/// Unit vector to the left of a line in the plane z = const; zero if the line has no direction.
Vector leftOf(const Vector& from, const Vector& to) {
  const Vector left(from.y() - to.y(), to.x() - from.x(), 0.0F);
  const float length = left.norm();
  return length > 0.0F ? Vector(left / length) : Vector(Vector::Zero());
}

/// Half the ribbon at a point, along the bisector of both pieces' normals (miter).
Vector ribbonSide(const Vectors& points, std::size_t i, float half_width) {
  const Vector before = i > 0 ? leftOf(points[i - 1], points[i]) : Vector(Vector::Zero());
  const Vector after = i + 1 < points.size() ? leftOf(points[i], points[i + 1]) : before;
  const Vector sum = (i > 0 ? before : after) + after;
  const float square = sum.squaredNorm();
  if (square <= 0.0F) {
    return half_width * after;
  }
  const float miter = std::min(2.0F / square, kMaxMiter / std::sqrt(square));
  return half_width * miter * sum;
}

void drawRibbon(const Vectors& points, Pencil& pencil) {
  const float half_width = 0.5F * pencil.scale().x();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector from = ribbonSide(points, i, half_width);
    const Vector to = ribbonSide(points, i + 1, half_width);
    pencil.quad(points[i] - from, points[i + 1] - to, points[i + 1] + to, points[i] + from);
  }
}

/// Flat, with the widths of the marker's shaft and head.
void drawArrow(const Vectors& points, Pencil& pencil) {
  if (points.size() != 2) {
    return;
  }
  const Vector ahead = points[1] - points[0];
  const float head = std::min(kHeadLength * pencil.scale().y(), kMaxHeadShare * ahead.norm());
  if (head <= 0.0F) {
    return;
  }
  const Vector neck = points[1] - head * ahead.normalized();
  drawRibbon({points[0], neck}, pencil);
  const Vector side = 0.5F * pencil.scale().y() * leftOf(points[0], points[1]);
  pencil.triangle(neck - side, points[1], neck + side);
}

void drawTriangles(const Marker& marker, const Vectors& points, Pencil& pencil) {
  const bool colored = marker.colors.size() == points.size();
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    if (colored) {
      pencil.triangle(points[i], points[i + 1], points[i + 2],
                      {marker.colors[i], marker.colors[i + 1], marker.colors[i + 2]});
    } else {
      pencil.triangle(points[i], points[i + 1], points[i + 2]);
    }
  }
}

void drawMesh(const Mesh& mesh, const std_msgs::ColorRGBA& paint, Pencil& pencil) {
  for (const MeshTriangle& triangle : mesh) {
    std_msgs::ColorRGBA color = triangle.color.value_or(paint);
    color.a = paint.a;
    const auto& [a, b, c] = triangle.corners;
    pencil.triangle(pencil.scale().cwiseProduct(a), pencil.scale().cwiseProduct(b),
                    pencil.scale().cwiseProduct(c), {color, color, color});
  }
}

bool isFinite(const Marker& marker, const Vectors& points) {
  const auto& p = marker.pose.position;
  const auto& q = marker.pose.orientation;
  const auto& s = marker.scale;
  const double sum = p.x + p.y + p.z + q.x + q.y + q.z + q.w + s.x + s.y + s.z;
  return std::isfinite(sum) && std::all_of(points.begin(), points.end(),
                                           [](const Vector& point) { return point.allFinite(); });
}

void draw(const Marker& marker, const Meshes& meshes, Drawing& drawing) {
  Vectors points;
  std::transform(marker.points.begin(), marker.points.end(), std::back_inserter(points), pointOf);
  if (!isFinite(marker, points)) {
    ++drawing.left_out;
    return;
  }
  Pencil pencil(marker, drawing);
  switch (marker.type) {
    case Marker::CUBE:
      return drawBox(pencil);
    case Marker::CYLINDER:
      return drawCylinder(pencil);
    case Marker::SPHERE:
      return drawSphere(pencil);
    case Marker::ARROW:
      return drawArrow(points, pencil);
    case Marker::LINE_STRIP:
      return drawRibbon(points, pencil);
    case Marker::LINE_LIST:
      for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        drawRibbon({points[i], points[i + 1]}, pencil);
      }
      return;
    case Marker::TRIANGLE_LIST:
      return drawTriangles(marker, points, pencil);
    case Marker::MESH_RESOURCE:
      if (const auto mesh = meshes.find(marker.mesh_resource); mesh != meshes.end()) {
        drawMesh(mesh->second, marker.color, pencil);
      }
      return;
    case Marker::TEXT_VIEW_FACING:
      drawing.labels.push_back({pointOf(marker.pose.position), marker.text,
                                static_cast<float>(marker.scale.z), marker.color});
      return;
    default:
      return;
  }
}

}  // namespace

Drawing drawingOf(const visualization_msgs::MarkerArray& markers, const Meshes& meshes) {
  Drawing drawing;
  for (const Marker& marker : markers.markers) {
    if (marker.action == Marker::ADD) {
      draw(marker, meshes, drawing);
    }
  }
  return drawing;
}

}  // namespace datmo
