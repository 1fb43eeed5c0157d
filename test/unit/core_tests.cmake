# SPDX-License-Identifier: BSD-3-Clause
# The tests of the core, by folder; vision links OpenCV, and is built with those of ROS.
datmo_fusion_add_core_test(common
  common/angle_test.cpp
  common/background_call_test.cpp
  common/box2_test.cpp
  common/class_belief_test.cpp
  common/clock_offset_test.cpp
  common/options_test.cpp
  common/pose2_test.cpp
  common/quantile_test.cpp
  common/renamed_options_test.cpp
  common/sensor_clock_reference_test.cpp
  common/sensor_clock_test.cpp
  common/stamp_gate_test.cpp
  common/stamp_test.cpp
  common/turned_test.cpp
  common/twist2_test.cpp
)

datmo_fusion_add_core_test(tracking
  tracking/association_scan_test.cpp
  tracking/association_test.cpp
  tracking/beam_evidence_test.cpp
  tracking/box_size_test.cpp
  tracking/class_by_size_test.cpp
  tracking/class_by_speed_test.cpp
  tracking/class_motion_test.cpp
  tracking/clutter_map_test.cpp
  tracking/crossing_test.cpp
  tracking/determinism_test.cpp
  tracking/disjoint_sets_test.cpp
  tracking/fused_objects_test.cpp
  tracking/gnn_equality_test.cpp
  tracking/grazing_test.cpp
  tracking/hypothesis_cluster_test.cpp
  tracking/imm_adaptation_test.cpp
  tracking/imm_filter_test.cpp
  tracking/imm_standing_test.cpp
  tracking/kalman_filter_test.cpp
  tracking/measured_velocity_test.cpp
  tracking/motion_by_beams_test.cpp
  tracking/early_tracker_test.cpp
  tracking/late_class_test.cpp
  tracking/existence_score_test.cpp
  tracking/motion_by_class_test.cpp
  tracking/motion_likelihood_test.cpp
  tracking/multiple_hypotheses_test.cpp
  tracking/nearest_neighbor_test.cpp
  tracking/object_check_test.cpp
  tracking/split_merge_readings_test.cpp
  tracking/split_merge_test.cpp
  tracking/stereo_noise_test.cpp
  tracking/target_motion_test.cpp
  tracking/track_check_test.cpp
  tracking/track_life_test.cpp
  tracking/tracked_box_simulation_test.cpp
  tracking/tracked_box_test.cpp
  tracking/tracker_robustness_test.cpp
  tracking/tracker_test.cpp
  tracking/transition_model_test.cpp
  tracking/transition_priors_test.cpp
  tracking/wide_clone_avx2.cpp
  tracking/wide_clone_default.cpp
  tracking/wide_functions_test.cpp
  tracking/wrong_classes_test.cpp
)

# The wide_clone files include sources of tracking in a namespace of their own.
set_source_files_properties(tracking/wide_clone_avx2.cpp tracking/wide_clone_default.cpp PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/src/tracking)
target_include_directories(unit_tracking PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
datmo_fusion_run_in_parts(tracking 2)

datmo_fusion_add_core_test(assignment
  assignment/assignment_test.cpp
  assignment/ranked_assignments_test.cpp
)

datmo_fusion_add_core_test(risk
  risk/box_contact_test.cpp
  risk/criticality_test.cpp
  risk/host_futures_test.cpp
  risk/host_motion_test.cpp
  risk/object_futures_test.cpp
  risk/object_start_test.cpp
  risk/risk_assessor_test.cpp
  risk/rule_methods_test.cpp
  risk/warning_level_test.cpp
)
target_include_directories(unit_risk PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

datmo_fusion_add_core_test(road
  road/border_offset_test.cpp
  road/border_scan_test.cpp
  road/border_search_test.cpp
  road/border_track_test.cpp
  road/branch_search_test.cpp
  road/intersection_detector_test.cpp
  road/passage_grid_test.cpp
  road/presence_history_test.cpp
  road/road_border_detector_test.cpp
  road/road_extension_test.cpp
  road/road_opening_test.cpp
  road/scan_novelty_test.cpp
  road/side_streets_test.cpp
  road/station_evidence_test.cpp
)
target_include_directories(unit_road PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

datmo_fusion_add_core_test(visibility
  visibility/beam_fan_test.cpp
  visibility/joint_visibility_test.cpp
  visibility/scan_history_test.cpp
  visibility/scan_support_test.cpp
  visibility/seen_points_test.cpp
  visibility/view_fan_test.cpp
  visibility/visibility_test.cpp
)
target_include_directories(unit_visibility PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

datmo_fusion_add_core_test(grid
  grid/beam_walk_test.cpp
  grid/distance_field_test.cpp
  grid/grid_resampling_test.cpp
  grid/hit_grid_test.cpp
  grid/map_evidence_test.cpp
  grid/map_surface_test.cpp
  grid/map_update_test.cpp
  grid/neighborhood_test.cpp
  grid/occupancy_map_test.cpp
  grid/ray_walk_test.cpp
  grid/rectangle_walk_test.cpp
  grid/rolling_grid_test.cpp
  grid/tile_store_test.cpp
)

datmo_fusion_add_core_test(sensor_model
  sensor_model/depth_camera_grid_test.cpp
  sensor_model/depth_noise_test.cpp
  sensor_model/lidar_grid_test.cpp
  sensor_model/road_plane_test.cpp
  sensor_model/scan_merger_test.cpp
  sensor_model/stereo_alignment_test.cpp
  sensor_model/stereo_cones_test.cpp
  sensor_model/stereo_grid_input_test.cpp
  sensor_model/stereo_grid_test.cpp
  sensor_model/stereo_view_test.cpp
  sensor_model/surface_pairs_test.cpp
)
target_include_directories(unit_sensor_model PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

datmo_fusion_add_core_test(slam
  slam/continued_slam_test.cpp
  slam/end_points_test.cpp
  slam/fused_slam_test.cpp
  slam/gradual_correction_test.cpp
  slam/grid_masked_scan_test.cpp
  slam/grid_slam_drift_test.cpp
  slam/grid_slam_test.cpp
  slam/keyframe_test.cpp
  slam/kidnapping_detector_test.cpp
  slam/kidnapping_test.cpp
  slam/loop_closer_test.cpp
  slam/map_drift_test.cpp
  slam/map_keeper_test.cpp
  slam/map_recovery_test.cpp
  slam/map_search_test.cpp
  slam/motion_compensation_test.cpp
  slam/motion_model_test.cpp
  slam/odometry_anchor_test.cpp
  slam/odometry_buffer_test.cpp
  slam/odometry_poses_test.cpp
  slam/pose_covariance_test.cpp
  slam/pose_filter_test.cpp
  slam/pose_graph_test.cpp
  slam/pose_motion_test.cpp
  slam/pose_scorer_test.cpp
  slam/prior_map_test.cpp
  slam/scan_matcher_test.cpp
  slam/searched_map_test.cpp
  slam/static_scan_test.cpp
  slam/submap_matcher_test.cpp
  slam/twist_gate_test.cpp
)
target_include_directories(unit_slam PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
datmo_fusion_run_in_parts(slam 4)

datmo_fusion_add_core_test(detection
  detection/border_filter_test.cpp
  detection/box_fit_test.cpp
  detection/camera_consistency_test.cpp
  detection/moving_object_detector_test.cpp
  detection/object_classifier_test.cpp
  detection/radar_object_detector_test.cpp
  detection/segment_end_test.cpp
  detection/segmentation_test.cpp
  detection/stereo_object_detector_test.cpp
)
target_include_directories(unit_detection PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

datmo_fusion_add_core_test(fusion
  fusion/aging_map_test.cpp
  fusion/cross_covariance_test.cpp
  fusion/earth_frame_test.cpp
  fusion/earth_start_test.cpp
  fusion/fused_existence_test.cpp
  fusion/fused_id_test.cpp
  fusion/fused_state_test.cpp
  fusion/class_memory_test.cpp
  fusion/fused_targets_test.cpp
  fusion/grid_fuser_test.cpp
  fusion/grid_fusion_test.cpp
  fusion/grid_matcher_test.cpp
  fusion/grid_motion_test.cpp
  fusion/map_changes_test.cpp
  fusion/map_fuser_test.cpp
  fusion/object_association_test.cpp
  fusion/object_class_combination_test.cpp
  fusion/object_combination_test.cpp
  fusion/object_consistency_test.cpp
  fusion/object_fuser_test.cpp
  fusion/position_covariance_test.cpp
  fusion/source_matcher_test.cpp
  fusion/station_renaming_test.cpp
  fusion/station_tracks_test.cpp
  fusion/track_association_test.cpp
  fusion/track_combination_test.cpp
  fusion/track_comparison_test.cpp
  fusion/track_consistency_test.cpp
  fusion/track_extents_test.cpp
  fusion/three_sources_test.cpp
  fusion/track_fuser_test.cpp
  fusion/track_prediction_test.cpp
  fusion/windowed_evidence_test.cpp
)

datmo_fusion_add_core_test(wire
  fusion/intersection_lanes_test.cpp
  fusion/signal_advice_test.cpp
  fusion/signal_events_test.cpp
  fusion/signal_messages_test.cpp
  fusion/signal_robustness_test.cpp
  fusion/signal_times_test.cpp
  fusion/station_encoding_test.cpp
  fusion/station_messages_test.cpp
  fusion/uper_test.cpp
  fusion/wire_messages_test.cpp
  fusion/wire_robustness_test.cpp
)
target_include_directories(unit_wire PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

datmo_fusion_add_core_test(device
  device/can_log_test.cpp
  device/can_motion_test.cpp
  device/can_signal_test.cpp
  device/can_vehicle_test.cpp
  device/capture_file_test.cpp
  device/capture_sample.cpp
  device/clock_estimator_test.cpp
  device/cola_test.cpp
  device/datagram_test.cpp
  device/device_events_test.cpp
  device/device_runner_test.cpp
  device/fake_hokuyo.cpp
  device/fake_lidar.cpp
  device/fake_serial.cpp
  device/fake_server.cpp
  device/fake_sick.cpp
  device/hokuyo_scanner_test.cpp
  device/hokuyo_serial_test.cpp
  device/nmea_receiver_test.cpp
  device/nmea_test.cpp
  device/scip_test.cpp
  device/sick_dialect_test.cpp
  device/sick_scanner_test.cpp
  device/sick_telegram_test.cpp
  device/velodyne_faults_test.cpp
  device/velodyne_lidar_test.cpp
  device/velodyne_loopback_test.cpp
  device/velodyne_packet_test.cpp
  device/velodyne_packets.cpp
)
target_include_directories(unit_device PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

# A separate program: it counts all allocations in the process.
datmo_fusion_add_core_test(memory
  allocation_count.cpp
  slam/steady_memory_test.cpp
  tracking/steady_memory_test.cpp
)
target_include_directories(unit_memory PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
