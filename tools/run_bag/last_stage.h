#pragma once

namespace datmo {

/// How far the chain of stages goes; each of them feeds the next.
enum class LastStage { kGridFusion, kGridSlam, kMovingObjects, kObjectFusion, kTracker };

}  // namespace datmo
