// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPainter>
#include <QSize>
#include <QString>

#include "datmo_fusion/ros/display/driver_view.h"

namespace datmo {

/// Draws the driver's picture on a whole widget: the host from above, driving up; road users as
/// icons by class, red for the one that causes the level; at the top the level and its reason in
/// words; at the side the remaining time to brake, and to contact. `view`: null if nothing is known
/// (no message, or too old), which is displayed. `fault`: why input is missing, at the bottom;
/// empty: it is not.
void paintDriverView(QPainter& painter, const QSize& size, const DriverView* view,
                     const QString& fault);

}  // namespace datmo
