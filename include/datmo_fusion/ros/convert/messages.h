// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <datmo_fusion/DroppedObjects.h>
#include <datmo_fusion/LabeledScan.h>
#include <datmo_fusion/LocalizationState.h>
#include <datmo_fusion/ObjectArray.h>
#include <datmo_fusion/PartClock.h>
#include <datmo_fusion/RoadBorders.h>
#include <datmo_fusion/StageTiming.h>
#include <datmo_fusion/StereoAlignment.h>
#include <datmo_fusion/TrackArray.h>
#include <datmo_fusion/TrueEchoes.h>
#include <datmo_fusion/TrueObjectArray.h>
#include <datmo_fusion/TrueRoadBorders.h>

namespace datmo {

// The package's messages under the names used in the code: generated code puts them into a
// namespace with the package's name. Names that a core struct also has get the suffix Message.
using DroppedObjectMessage = datmo_fusion::DroppedObject;
using FieldOfViewMessage = datmo_fusion::FieldOfView;
using ObjectMessage = datmo_fusion::Object;
using PathPointMessage = datmo_fusion::PathPoint;
using RoadBorderMessage = datmo_fusion::RoadBorder;
using ScanFieldMessage = datmo_fusion::ScanField;
using ScanPointMessage = datmo_fusion::ScanPoint;
using SourceTrackMessage = datmo_fusion::SourceTrack;
using LabeledScanMessage = datmo_fusion::LabeledScan;
using StereoAlignmentMessage = datmo_fusion::StereoAlignment;
using StereoAlignmentMessagePtr = datmo_fusion::StereoAlignmentPtr;
using TrackMessage = datmo_fusion::Track;
using ViewFanMessage = datmo_fusion::ViewFan;
using datmo_fusion::DroppedObjects;
using datmo_fusion::DroppedObjectsConstPtr;
using datmo_fusion::DroppedObjectsPtr;
using datmo_fusion::LabeledScanConstPtr;
using datmo_fusion::LabeledScanPtr;
using datmo_fusion::LocalizationState;
using datmo_fusion::LocalizationStatePtr;
using datmo_fusion::ObjectArray;
using datmo_fusion::ObjectArrayConstPtr;
using datmo_fusion::ObjectArrayPtr;
using datmo_fusion::PartClock;
using datmo_fusion::PartClockConstPtr;
using datmo_fusion::RoadBorders;
using datmo_fusion::RoadBordersConstPtr;
using datmo_fusion::RoadBordersPtr;
using datmo_fusion::StageTiming;
using datmo_fusion::StageTimingConstPtr;
using datmo_fusion::TrackArray;
using datmo_fusion::TrackArrayConstPtr;
using datmo_fusion::TrackArrayPtr;
using datmo_fusion::TrueEchoes;
using datmo_fusion::TrueObject;
using datmo_fusion::TrueObjectArray;
using datmo_fusion::TrueObjectArrayConstPtr;
using datmo_fusion::TrueRoadBorders;

}  // namespace datmo
