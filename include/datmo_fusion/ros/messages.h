#pragma once

// The messages that have a struct of the same name in the core: generated code puts them into the
// namespace of the package, which is the core's. Here, and in every file that needs both, they are
// called <Name>Message; their Ptr and ConstPtr types keep their names.
#define Object ObjectMessage
#define ScanPoint ScanPointMessage
#define SplitScan SplitScanMessage
#define Track TrackMessage
#include <datmo_fusion/ObjectArray.h>
#include <datmo_fusion/SplitScan.h>
#include <datmo_fusion/TrackArray.h>
#undef Object
#undef ScanPoint
#undef SplitScan
#undef Track
