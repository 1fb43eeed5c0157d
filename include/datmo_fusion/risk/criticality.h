// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/risk/host_motion.h"

namespace datmo {

/// The host on its predicted path, and the body that it would touch.
struct Encounter {
  const BodyPath& host;
  const BodySize& host_size;
  const BodyPath& other;
  const BodySize& other_size;
};

/// Returns the host's path if it brakes with `deceleration` (m/s^2, at least 0) from `start` (s)
/// on, along the same line: it comes to rest and remains stationary.
BodyPath braked(const BodyPath& host, double start, double deceleration);

/// Returns the host's path if it evades from now on with this lateral acceleration (m/s^2, positive
/// to the left) in addition to its own.
BodyPath steered(const BodyPath& host, double lateral);

/// Returns how long the host can wait before it must brake with `max_braking` (m/s^2, more than 0)
/// to avoid contact, s: 0 if braking is too late, the duration of the paths if there is no contact
/// (time to brake; Hillenbrand, Spieker, Kroschel, A Multilevel Collision Mitigation Approach, IEEE
/// Trans. ITS 7(4), 2006).
double timeToBrake(const Encounter& encounter, double max_braking);

/// Returns the deceleration that avoids contact if the host brakes now, divided by `max_braking`:
/// more than 1 cannot be reached (brake threat number; Brännström, Coelingh, Sjöberg, Model-Based
/// Threat Assessment for Avoiding Arbitrary Vehicle Collisions, IEEE Trans. ITS 11(3), 2010). 0: no
/// contact without braking; kHopeless: not even four times as much is enough.
double brakeThreat(const Encounter& encounter, double max_braking);

/// Returns the same for the smaller of the lateral accelerations to the left or right that avoid
/// contact, divided by `max_lateral` (steer threat number).
double steerThreat(const Encounter& encounter, double max_lateral);

/// Threat number of an unavoidable contact.
inline constexpr double kHopeless = 4.0;

/// Returns the time between one body leaving the area that both paths share and the other reaching
/// it, s: the least time by which one of them must be shifted for them to touch (post-encroachment
/// time; Allen, Shin, Cooper, Analysis of Traffic Conflicts and Collisions, TRR 667, 1978,
/// predicted). 0: they touch; infinite: their paths do not cross.
double postEncroachmentTime(const Encounter& encounter);

}  // namespace datmo
