// SPDX-License-Identifier: BSD-3-Clause
#include "driver_painter.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "datmo_fusion/ros/display/marker_colors.h"

namespace datmo {

namespace {

/// m, range of the picture ahead of and behind the host.
constexpr double kAhead = 42.0;
constexpr double kBehind = 10.0;

/// m, spacing of the range arcs, and the farthest one.
constexpr int kArcSpacing = 10;
constexpr int kFarthestArc = 40;

/// s at a full bar.
constexpr double kFullBar = 4.0;

/// m; minimum icon size: a pedestrian must be visible.
constexpr double kMinIcon = 1.2;

/// Pixels.
constexpr int kBanner = 88;
constexpr int kTitle = 36;  // of it, above the reason
constexpr int kBar = 26;
constexpr int kMargin = 8;
constexpr int kFault = 64;  // height of the text at the bottom

const QColor kGround(38, 42, 48);
const QColor kPale(150, 156, 164);
const QColor kHostPaint(242, 204, 26);

QColor toQt(const std_msgs::ColorRGBA& color) {
  return QColor::fromRgbF(static_cast<double>(color.r), static_cast<double>(color.g),
                          static_cast<double>(color.b), static_cast<double>(color.a));
}

QString nameOfLevel(std::uint8_t level) {
  switch (level) {
    case RiskArray::LEVEL_NONE:
      return "no risk";
    case RiskArray::LEVEL_INFORMATION:
      return "attention";
    case RiskArray::LEVEL_WARNING:
      return "WARNING";
    default:
      return "BRAKE";
  }
}

/// Converts the host's frame (x forward, y left, m) to pixels.
class Ground {
 public:
  explicit Ground(const QRect& area)
      : scale_(area.height() / (kAhead + kBehind)),
        origin_(area.center().x(), area.top() + kAhead * scale_) {}

  QPointF at(const Point2& point) const {
    return origin_ + scale_ * QPointF(-point.y(), -point.x());
  }
  double pixels(double meters) const { return scale_ * meters; }
  QPointF origin() const { return origin_; }

 private:
  double scale_;
  QPointF origin_;
};

QPolygonF boxOf(const Ground& ground, const Pose2& pose, double length, double width) {
  const double x = 0.5 * length;
  const double y = 0.5 * width;
  QPolygonF polygon;
  for (const Point2& corner : {Point2(x, y), Point2(x, -y), Point2(-x, -y), Point2(-x, y)}) {
    polygon << ground.at(pose * corner);
  }
  return polygon;
}

void paintArcs(QPainter& painter, const Ground& ground) {
  painter.setPen(QPen(QColor(80, 86, 94), 1, Qt::DashLine));
  painter.setBrush(Qt::NoBrush);
  for (int distance = kArcSpacing; distance <= kFarthestArc; distance += kArcSpacing) {
    const double radius = ground.pixels(distance);
    painter.drawEllipse(ground.origin(), radius, radius);
    painter.drawText(ground.origin() + QPointF(3.0, -radius - 2.0), QString("%1 m").arg(distance));
  }
}

/// The ground that the host is predicted to cover.
void paintTube(QPainter& painter, const Ground& ground, const DriverView& view) {
  QColor fill = toQt(colorOfLevel(view.level));
  fill.setAlpha(90);
  painter.setPen(Qt::NoPen);
  painter.setBrush(fill);
  QPolygonF left;
  QPolygonF right;
  for (const Pose2& pose : view.path) {
    const double ahead = 0.5 * view.host_length;
    left << ground.at(pose * Point2(ahead, 0.5 * view.host_width));
    right.prepend(ground.at(pose * Point2(ahead, -0.5 * view.host_width)));
  }
  painter.drawPolygon(left + right);
}

void paintPerson(QPainter& painter, const Ground& ground, const DriverIcon& icon) {
  const QPointF middle = ground.at(icon.pose.position());
  const double radius = 0.5 * ground.pixels(std::max(kMinIcon, icon.length));
  painter.drawEllipse(middle, radius, radius);
  painter.drawLine(middle, ground.at(icon.pose * Point2(1.6 * kMinIcon, 0.0)));
}

/// Two wheels and a rider.
void paintCyclist(QPainter& painter, const Ground& ground, const DriverIcon& icon) {
  const double length = std::max(1.7, icon.length);
  painter.drawLine(ground.at(icon.pose * Point2(0.5 * length, 0.0)),
                   ground.at(icon.pose * Point2(-0.5 * length, 0.0)));
  const double wheel = ground.pixels(0.2 * length);
  painter.drawEllipse(ground.at(icon.pose * Point2(0.4 * length, 0.0)), wheel, wheel);
  painter.drawEllipse(ground.at(icon.pose * Point2(-0.4 * length, 0.0)), wheel, wheel);
}

/// With a windshield, which shows its heading.
void paintVehicle(QPainter& painter, const Ground& ground, const DriverIcon& icon) {
  const double length = std::max(kMinIcon, icon.length);
  const double width = std::max(kMinIcon, icon.width);
  painter.drawPolygon(boxOf(ground, icon.pose, length, width));
  painter.drawLine(ground.at(icon.pose * Point2(0.2 * length, 0.4 * width)),
                   ground.at(icon.pose * Point2(0.2 * length, -0.4 * width)));
}

void paintIcon(QPainter& painter, const Ground& ground, const DriverIcon& icon) {
  const QColor own = toQt(colorOfClass(icon.object_class, true, 1.0F));
  painter.setBrush(icon.is_cause ? QColor(225, 30, 40) : own);
  painter.setPen(QPen(icon.is_cause ? QColor(255, 235, 235) : kPale, icon.is_cause ? 3 : 1));
  switch (icon.object_class) {
    case ObjectClass::kPedestrian:
      return paintPerson(painter, ground, icon);
    case ObjectClass::kCyclist:
      return paintCyclist(painter, ground, icon);
    case ObjectClass::kVehicle:
    case ObjectClass::kPole:
    case ObjectClass::kUnknown:
      return paintVehicle(painter, ground, icon);
  }
}

void paintHost(QPainter& painter, const Ground& ground, const DriverView& view) {
  painter.setBrush(kHostPaint);
  painter.setPen(QPen(Qt::black, 1));
  const DriverIcon host{
      0, ObjectClass::kVehicle, Pose2(), view.host_length, view.host_width, 0.0, false};
  paintVehicle(painter, ground, host);
}

void paintContact(QPainter& painter, const Ground& ground, const Point2& contact) {
  const QPointF middle = ground.at(contact);
  const double reach = ground.pixels(1.2);
  painter.setPen(QPen(QColor(255, 60, 60), 3));
  painter.drawLine(middle + QPointF(-reach, -reach), middle + QPointF(reach, reach));
  painter.drawLine(middle + QPointF(-reach, reach), middle + QPointF(reach, -reach));
}

void paintBanner(QPainter& painter, int width, const DriverView& view) {
  const QRect banner(0, 0, width, kBanner);
  painter.fillRect(banner, toQt(colorOfLevel(view.level)));
  painter.setPen(view.level == RiskArray::LEVEL_INFORMATION ? Qt::black : Qt::white);
  QFont font = painter.font();
  font.setBold(true);
  font.setPixelSize(18);
  painter.setFont(font);
  const int half = view.reason.empty() ? kBanner : kTitle;
  painter.drawText(QRect(kMargin, 0, width - 2 * kMargin, half), Qt::AlignCenter,
                   nameOfLevel(view.level));
  font.setBold(false);
  font.setPixelSize(14);
  painter.setFont(font);
  painter.drawText(QRect(kMargin, half, width - 2 * kMargin, kBanner - half),
                   Qt::AlignCenter | Qt::TextWordWrap, QString::fromStdString(view.reason));
}

/// A column that empties as time runs out.
void paintBar(QPainter& painter, const QRect& bar, double seconds, const QString& name) {
  const double share = std::clamp(seconds / kFullBar, 0.0, 1.0);
  const int filled = static_cast<int>(share * bar.height());
  painter.setPen(QPen(kPale, 1));
  painter.setBrush(Qt::NoBrush);
  painter.fillRect(QRect(bar.left(), bar.bottom() - filled, bar.width(), filled),
                   toQt(colorOfTime(seconds, kFullBar, 1.0F)));
  painter.drawRect(bar);
  painter.setPen(Qt::white);
  const QRect text(bar.left() - kBar, bar.bottom() + 2, 3 * kBar, 30);
  painter.drawText(text, Qt::AlignHCenter | Qt::AlignTop,
                   QString("%1\n%2 s").arg(name).arg(seconds, 0, 'f', 1));
}

void paintFault(QPainter& painter, const QSize& size, const QString& fault) {
  const QRect bottom(0, size.height() - kFault, size.width(), kFault);
  painter.fillRect(bottom, kGround);
  QFont font = painter.font();
  font.setPixelSize(11);
  painter.setFont(font);
  painter.setPen(kHostPaint);
  painter.drawText(bottom.adjusted(kMargin, 0, -kMargin, 0), Qt::AlignCenter | Qt::TextWordWrap,
                   fault);
}

}  // namespace

void paintDriverView(QPainter& painter, const QSize& size, const DriverView* view,
                     const QString& fault) {
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(QRect(QPoint(), size), kGround);
  if (!view) {
    painter.setPen(kPale);
    painter.drawText(
        QRect(QPoint(), size), Qt::AlignCenter | Qt::TextWordWrap,
        fault.isEmpty() ? "no risks: expected them with risk:=true" : "no risks\n" + fault);
    return;
  }
  const Ground ground(QRect(0, kBanner, size.width(), size.height() - kBanner));
  paintArcs(painter, ground);
  paintTube(painter, ground, *view);
  for (const DriverIcon& icon : view->icons) {
    paintIcon(painter, ground, icon);
  }
  paintHost(painter, ground, *view);
  if (view->contact) {
    paintContact(painter, ground, *view->contact);
  }
  const int top = kBanner + 2 * kMargin;
  const int height = std::max(20, size.height() / 2 - top);
  if (view->ttc) {
    paintBar(painter, QRect(size.width() - 2 * kBar, top, kBar, height), *view->ttc, "contact");
  }
  if (view->time_to_brake) {
    paintBar(painter, QRect(kBar, top, kBar, height), *view->time_to_brake, "brake in");
  }
  paintBanner(painter, size.width(), *view);
  if (!fault.isEmpty()) {
    paintFault(painter, size, fault);
  }
}

}  // namespace datmo
