// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPainter>
#include <QSize>

#include "datmo_fusion/ros/display/driver_view.h"

namespace datmo {

/// Draws the driver's picture over the whole of a widget: the host from above, driving up; road
/// users as icons by class, in red what the level is for; the level and its reason in words at the
/// top; at the side the time that is left to brake, and to contact. `view`: null where nothing is
/// known (no message, or too old a one), which is said.
void paintDriverView(QPainter& painter, const QSize& size, const DriverView* view);

}  // namespace datmo
