// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/fusion/wire/cpm.h"

namespace datmo {

// Skipped fields of a perceived object, and its class, most of which is ignored (ETSI TS 102
// 894-2).

/// DF Acceleration3dWithConfidence.
void skipAccelerationVector(Uper& uper);

/// DF CartesianAngularVelocityComponent.
void skipAngularVelocity(Uper& uper);

/// DF LowerTriangularPositiveSemidefiniteMatrices.
void skipCorrelations(Uper& uper, ItsDictionary dictionary);

/// DF SequenceOfIdentifier1B.
void skipSensors(Uper& uper);

/// DF MapPosition.
void skipMapPosition(Uper& uper);

/// DF ObjectClass.
void walkClass(Uper& uper, CpmClass& one, ItsDictionary dictionary);

}  // namespace datmo
