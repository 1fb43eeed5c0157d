#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""live.launch: the chain of perception.launch with the requested devices; unknown kinds of devices
are refused."""

import shlex
import tempfile
import unittest

import roslaunch
from launch_files import PACKAGE, load

from datmo_tools.launch_arguments import missing_device

MACHINES = f"machines:={PACKAGE}/test/nodelets/parts_machines.launch"


def loaded(*words):
    """Returns the nodes by name, and the parameters."""
    config = load("live.launch", list(words))
    return ({node.name: node for node in config.nodes},
            {key: parameter.value for key, parameter in config.params.items()})


class LiveLaunch(unittest.TestCase):
    def test_with_external_devices_it_is_the_chain(self):
        nodes, parameters = loaded("scan:=/front/scan", "odometry_topic:=/wheels", "risk:=true")
        chain = {node.name for node in load("perception.launch", ["risk:=true"]).nodes}
        self.assertEqual(set(nodes), chain)
        remaps = dict(nodes["grid_slam"].remap_args)
        self.assertEqual(remaps["scan"], "/front/scan")
        self.assertEqual(remaps["odometry"], "/wheels")
        self.assertNotEqual(parameters.get("/motion/source"), "none")

    def test_tracks_do_not_wait_for_the_camera_by_default(self):
        _, early = loaded("object_fusion:=true", "track_fusion:=true")
        self.assertIs(early["/object_fusion/retroactive"], True)
        self.assertEqual(early["/track_fusion/max_wait"], 0.0)
        _, waiting = loaded("object_fusion:=true", "track_fusion:=true", "early_tracks:=false")
        self.assertNotIn("/object_fusion/retroactive", waiting)
        self.assertNotEqual(waiting.get("/track_fusion/max_wait"), 0.0)

    def test_the_sensor_set_decides_about_early_tracks(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as settings:
            settings.write("track_fusion: {max_wait: 0.1}\nobject_fusion: {retroactive: false}\n")
            settings.flush()
            _, parameters = loaded("object_fusion:=true", "track_fusion:=true", f"config:={settings.name}")
        self.assertEqual(parameters["/track_fusion/max_wait"], 0.1)
        self.assertEqual(parameters["/track_fusion/tolerance"], 0.7)
        self.assertIs(parameters["/object_fusion/retroactive"], False)

    def test_a_scanner_of_hokuyos_is_served_in_the_same_process(self):
        nodes, parameters = loaded("lidar:=hokuyo", "lidar_address:=10.0.0.7", "lidar_frame:=roof",
                                   "scan:=/front/scan")
        self.assertEqual(nodes["device"].args, "load datmo_fusion/device perception")
        self.assertEqual(dict(nodes["device"].remap_args)["scan"], "/front/scan")
        self.assertEqual(parameters["/device/kind"], "hokuyo")
        self.assertEqual(parameters["/device/address"], "10.0.0.7")
        self.assertEqual(parameters["/device/port"], 0)
        self.assertEqual(parameters["/device/frame"], "roof")

    def test_a_scanner_of_sicks_is_served_at_the_address_of_its_factory(self):
        _, parameters = loaded("lidar:=sick_lms")
        self.assertEqual(parameters["/device/kind"], "sick_lms")
        self.assertEqual(parameters["/device/address"], "192.168.0.1")

    def test_a_lidar_of_velodynes_takes_the_place_of_the_scan(self):
        nodes, parameters = loaded("lidar:=velodyne", "lidar_recording:=/a b/drive.pcap")
        self.assertEqual(parameters["/device/kind"], "velodyne")
        self.assertEqual(parameters["/device/address"], "")
        self.assertEqual(parameters["/device/recording"], "/a b/drive.pcap")
        self.assertEqual(dict(nodes["device"].remap_args)["points"],
                         dict(nodes["cloud_to_scan"].remap_args)["cloud"])
        self.assertEqual(dict(nodes["grid_slam"].remap_args)["scan"], "cloud_scan")

    def test_a_front_and_a_rear_scanner_are_merged(self):
        nodes, parameters = loaded("lidar:=sick_lms", "rear_lidar:=hokuyo", "rear_lidar_address:=/dev/ttyACM0",
                                   "rear_lidar_frame:=tail")
        merged = dict(nodes["scan_merge"].remap_args)
        for name, source in (("device", "front"), ("rear_device", "rear")):
            self.assertEqual(nodes[name].args, "load datmo_fusion/device perception")
            self.assertEqual(dict(nodes[name].remap_args)["scan"], merged[f"scans/{source}"])
        self.assertEqual(dict(nodes["grid_slam"].remap_args)["scan"], merged["scan"])
        self.assertEqual([parameters[f"/rear_device/{key}"] for key in ("kind", "address", "port", "frame")],
                         ["hokuyo", "/dev/ttyACM0", 0, "tail"])
        self.assertEqual(parameters["/device/kind"], "sick_lms")
        nodes, _ = loaded("lidar:=hokuyo", "rear_lidar:=sick_lms", "rear_lidar_address:=192.168.0.2",
                          "front_scan:=/front", "rear_scan:=/rear", MACHINES, "sensors_machine:=sensors")
        self.assertEqual([dict(nodes[name].remap_args)["scan"] for name in ("device", "rear_device")],
                         ["/front", "/rear"])
        self.assert_place(nodes["rear_device"], "perception_sensors", "sensors")

    def test_each_device_has_a_section_of_the_yaml_file(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as settings:
            settings.write("rear_device: {hokuyo: {baud: 230400}}\nsatellite_receiver: {nmea: {sigma: 2.0}}\n"
                           "vehicle_bus: {timeout: 2.0}\ndevice: {timeout: 0.5}\n")
            settings.flush()
            _, parameters = loaded(f"config:={settings.name}")
        self.assertEqual(parameters["/rear_device/hokuyo/baud"], 230400)

    def test_a_rear_scanner_may_have_another_driver(self):
        nodes, _ = loaded("rear_lidar:=external", "rear_scan:=/rear")
        self.assertEqual(dict(nodes["scan_merge"].remap_args)["scans/rear"], "/rear")
        self.assertNotIn("rear_device", nodes)
        nodes, _ = loaded()
        self.assertNotIn("scan_merge", nodes)

    def test_images_of_files_are_played(self):
        nodes, _ = loaded("camera:=images", "left_images:=/a b/left", "left_info:=/l.yaml")
        self.assertEqual(shlex.split(nodes["play_images"].args),
                         ["--rate", "12.0", "/a b/left", "/l.yaml"])
        nodes, _ = loaded("camera:=images", "left_images:=/l", "left_info:=/l.yaml",
                          "right_images:=/r", "right_info:=/r.yaml", "image_options:=--raw")
        self.assertEqual(shlex.split(nodes["play_images"].args),
                         ["--rate", "12.0", "--raw", "/l", "/l.yaml", "/r", "/r.yaml"])

    def test_a_usb_camera_is_opened(self):
        nodes, _ = loaded("camera:=usb", "left_info:=/a b/l.yaml", "camera_options:=--rate 15")
        self.assertEqual(shlex.split(nodes["usb_camera"].args), ["--rate", "15", "/dev/video0", "/a b/l.yaml"])
        nodes, _ = loaded("camera:=usb_stereo", "camera_device:=/dev/video2", "left_info:=/l.yaml", "right_info:=/r.yaml",
                          MACHINES, "stereo_machine:=stereo")  # fmt: skip
        self.assertEqual(shlex.split(nodes["usb_camera"].args), ["/dev/video2", "/l.yaml", "/r.yaml"])
        self.assertEqual(nodes["usb_camera"].machine_name, "stereo")
        nodes, _ = loaded("camera:=external")
        self.assertNotIn("usb_camera", nodes)

    def test_images_are_played_where_they_are_taken(self):
        files = ("camera:=images", "left_images:=/l", "left_info:=/l.yaml")
        nodes, _ = loaded(*files)
        self.assertIsNone(nodes["play_images"].machine_name)
        nodes, _ = loaded(*files, MACHINES, "stereo_machine:=stereo")
        self.assertEqual(nodes["play_images"].machine_name, "stereo")

    def assert_place(self, node, process, machine):
        """A nodelet's process, and the machine of both."""
        self.assertEqual((node.args.split()[2], node.machine_name), (process, machine))

    def test_devices_are_served_where_they_are_connected(self):
        devices = ("lidar:=velodyne", MACHINES)
        for odometry, name in (("gps_imu", "satellite_receiver"), ("can", "vehicle_bus"), ("can_imu", "vehicle_bus")):
            with self.subTest(odometry):
                words = (*devices, f"odometry:={odometry}")
                nodes, _ = loaded(*words)
                for device in (nodes["device"], nodes[name]):
                    self.assert_place(device, "perception", None)
                nodes, _ = loaded(*words, "perception_machine:=perception")
                for device in (nodes["device"], nodes[name]):
                    self.assert_place(device, "perception", "perception")
                nodes, _ = loaded(*words, "perception_machine:=perception", "sensors_machine:=sensors")
                for device in (nodes["device"], nodes[name]):
                    self.assert_place(device, "perception_sensors", "sensors")
                    self.assertEqual(nodes["perception_sensors"].machine_name, "sensors")

    def test_other_stations_are_received_at_the_given_port(self):
        words = ("v2x_wire:=true", "track_fusion:=true", MACHINES, "perception_machine:=perception")
        nodes, _ = loaded(*words, "sensors_machine:=sensors")
        self.assert_place(nodes["v2x_wire"], "perception", "perception")
        for part in ("sensors", "stereo", "risk"):
            nodes, _ = loaded(*words, f"v2x_part:={part}", f"{part}_machine:={part}")
            self.assert_place(nodes["v2x_wire"], f"perception_{part}", part)
            nodes, _ = loaded(*words, f"v2x_part:={part}")
            self.assert_place(nodes["v2x_wire"], "perception", "perception")

    def test_without_odometry_the_motion_comes_from_the_scans(self):
        _, parameters = loaded("odometry:=none")
        self.assertEqual(parameters["/motion/source"], "none")

    def test_a_satellite_receiver_and_an_imu_give_the_motion(self):
        nodes, parameters = loaded("odometry:=gps_imu", "gnss_address:=10.0.0.9", "gnss:=/fix", "twist:=/gnss/twist",
                                   "imu:=/imu/data")
        self.assertEqual(parameters["/motion/source"], "imu_and_twist")
        self.assertEqual(nodes["satellite_receiver"].args, "load datmo_fusion/device perception")
        self.assertEqual(parameters["/satellite_receiver/kind"], "nmea")
        self.assertEqual(parameters["/satellite_receiver/address"], "10.0.0.9")
        self.assertEqual(dict(nodes["satellite_receiver"].remap_args)["gnss"], "/fix")
        self.assertEqual(dict(nodes["motion"].remap_args)["twist"], "/gnss/twist")
        self.assertEqual(dict(nodes["motion"].remap_args)["imu"], "/imu/data")

    def test_a_vehicles_bus_gives_the_motion(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as signals:
            signals.write("can: {speed: Brakes.Speed, yaw_rate: Yaw}\n")
            signals.flush()
            words = (f"can_signals:={signals.name}", "can_interface:=can1", "can_dbc:=/a b/car.dbc", "twist:=/car")
            nodes, parameters = loaded("odometry:=can", *words)
            self.assertEqual(parameters["/motion/source"], "twist")
            self.assertEqual(nodes["vehicle_bus"].args, "load datmo_fusion/device perception")
            self.assertEqual(dict(nodes["vehicle_bus"].remap_args)["twist"], "/car")
            self.assertEqual(dict(nodes["motion"].remap_args)["twist"], "/car")
            self.assertEqual(parameters["/vehicle_bus/kind"], "can")
            self.assertEqual(parameters["/vehicle_bus/address"], "can1")
            self.assertEqual(parameters["/vehicle_bus/can/speed"], "Brakes.Speed")
            self.assertEqual(parameters["/vehicle_bus/can/dbc"], "/a b/car.dbc")
            self.assertNotIn("/vehicle_bus/can/yaw_from", parameters)
            _, parameters = loaded("odometry:=can_imu", "can_recording:=/drive.log", *words)
            self.assertEqual(parameters["/motion/source"], "imu_and_twist")
            self.assertEqual(parameters["/vehicle_bus/can/yaw_from"], "none")
            self.assertEqual(parameters["/vehicle_bus/recording"], "/drive.log")

    def test_messages_of_other_stations_are_received_and_sent(self):
        nodes, parameters = loaded("v2x_wire:=true", "track_fusion:=true", "v2x_port:=5000",
                                   "v2x_destination:=10.0.0.5", "stations:=/others")
        self.assertEqual(nodes["v2x_wire"].args, "load datmo_fusion/v2x_wire perception")
        self.assertEqual(parameters["/v2x_wire/port"], 5000)
        self.assertEqual(parameters["/v2x_wire/destination"], "10.0.0.5")
        self.assertEqual(parameters["/v2x_wire/destination_port"], 37001)
        self.assertEqual(dict(nodes["v2x"].remap_args)["stations"], "/others")
        self.assertEqual(dict(nodes["v2x_wire"].remap_args)["stations"], "/others")
        nodes, _ = loaded()
        self.assertNotIn("v2x_wire", nodes)
        self.assertNotIn("v2x", nodes)

    def test_unknown_devices_end_it(self):
        for word in ("lidar:=ouster", "camera:=webcam", "odometry:=magic", "rear_lidar:=velodyne"):
            with self.subTest(word):
                with self.assertRaises(roslaunch.RLException):
                    loaded(word)
        with self.assertRaises(roslaunch.RLException):
            loaded("rear_lidar:=hokuyo", "rear_lidar_address:=10.0.0.2", "merge_scans:=false")


class MissingDevice(unittest.TestCase):
    def test_known_devices_are_accepted(self):
        self.assertIsNone(missing_device(["lidar:=hokuyo", "camera:=external", "odometry:=none"]))

    def test_a_usb_camera_needs_its_calibrations(self):
        self.assertIn("camera:=usb without left_info", missing_device(["camera:=usb", "left_info:="]))
        self.assertIn("camera:=usb_stereo without right_info",
                      missing_device(["camera:=usb_stereo", "left_info:=l.yaml", "right_info:="]))
        self.assertIsNone(missing_device(["camera:=usb", "left_info:=l.yaml", "right_info:="]))

    def test_a_rear_scanner_needs_an_address_and_another_planar_one(self):
        self.assertIn("rear_lidar:=hokuyo without rear_lidar_address",
                      missing_device(["rear_lidar:=hokuyo", "rear_lidar_address:=", "cloud:="]))
        self.assertIn("rear_lidar:=external with clouds on points",
                      missing_device(["rear_lidar:=external", "rear_lidar_address:=", "cloud:=points"]))
        self.assertIn("rear_lidar:=hokuyo with merge_scans:=false",
                      missing_device(["rear_lidar:=hokuyo", "rear_lidar_address:=10.0.0.2", "cloud:=", "merge_scans:=false"]))
        self.assertIsNone(missing_device(["rear_lidar:=hokuyo", "rear_lidar_address:=10.0.0.2", "cloud:=", "merge_scans:=true"]))

    def test_signals_of_a_bus_are_those_of_a_file(self):
        self.assertIn("/none.yaml: expected a yaml file", missing_device(["odometry:=can", "can_signals:=/none.yaml"]))
        for words in (["odometry:=can", "can_signals:="], ["odometry:=external", "can_signals:=/none.yaml"]):
            self.assertIsNone(missing_device(words))

    def test_the_message_says_what_there_is_and_what_to_do(self):
        said = missing_device(["lidar:=ouster"])
        self.assertIn("lidar:=ouster: no driver in this package, expected one of external, hokuyo, sick_lms, "
                      "velodyne; ",
                      said)
        self.assertIn("ouster_ros", said)
        self.assertIn("odometry:=magic: no driver in this package, expected one of external, can, can_imu, "
                      "gps_imu, none",
                      missing_device(["lidar:=external", "odometry:=magic"]))


if __name__ == "__main__":
    unittest.main()
