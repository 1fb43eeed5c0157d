# SPDX-License-Identifier: BSD-3-Clause
"""Reads the registrations of a ROS master, and registers them with another one by the master API.

Nodes register at startup and never again, so a restarted master knows none of the running nodes.
They stay connected to each other, but new nodes cannot find them, and their parameters are gone.
"""

import socket
from typing import NamedTuple
from urllib.parse import urlsplit

import rosgraph

ANY_TYPE = "*"  # for a topic whose type is not known
PATIENCE = 1.0  # s, to wait for a node on the network to accept a connection


class Registrations(NamedTuple):
    """What a master knows at one time."""

    nodes: dict  # URI of each, by name
    publishers: list  # (topic, node)
    subscribers: list  # (topic, node)
    services: dict  # URI, by (service, node)
    types: dict  # of topics
    parameters: dict  # the tree from / on


NOTHING = Registrations({}, [], [], {}, {}, {})


def read(master, before=NOTHING):
    """Returns the Registrations of a rosgraph.Master; with `before`, asks only for what is new.

    Raises OSError if it does not answer, MasterError if a node shut down meanwhile.
    """
    publishers, subscribers, services = (
        [(name, node) for name, nodes in part for node in nodes] for part in master.getSystemState())
    nodes = {node: master.lookupNode(node) for node in {node for _, node in publishers + subscribers + services}}

    def service_uri(service, node):
        is_known = (service, node) in before.services and before.nodes[node] == nodes[node]
        return before.services[service, node] if is_known else master.lookupService(service)

    return Registrations(
        nodes, publishers, subscribers, {(service, node): service_uri(service, node) for service, node in services},
        dict(master.getTopicTypes()), master.getParam("/"))


def write(master, before):
    """Registers with a new rosgraph.Master what `before` has, but nothing outdated and no dead
    nodes.

    Returns the names of the nodes that are registered again.
    """
    now = read(master)
    for key, value in missing(before.parameters, now.parameters):
        master.setParam(key, value)
    nodes = {node: api for node, api in before.nodes.items() if now.nodes.get(node, api) == api and answers(api)}
    publishers, subscribers, services = ([each for each in part if each[1] in nodes]
                                         for part in (before.publishers, before.subscribers, before.services))
    as_node = {node: rosgraph.Master(node, master.master_uri) for node in nodes}
    # Publishers first: a subscriber that learns of only some of them would drop the others.
    for topic, node in publishers:
        as_node[node].registerPublisher(topic, before.types.get(topic, ANY_TYPE), nodes[node])
    for topic, node in subscribers:
        as_node[node].registerSubscriber(topic, before.types.get(topic, ANY_TYPE), nodes[node])
    for service, node in services:
        as_node[node].registerService(service, before.services[service, node], nodes[node])
    # Registering a publisher makes the master notify all subscribers, also those that registered
    # meanwhile.
    after = read(master)
    for topic, node in dict(after.publishers).items():
        kind = after.types.get(topic, ANY_TYPE)
        rosgraph.Master(node, master.master_uri).registerPublisher(topic, kind, after.nodes[node])
    return sorted(nodes)


def missing(before, now, name=""):
    """Yields (key, value) of each parameter, or tree of parameters, that no longer exists."""
    for key, value in before.items():
        if key not in now:
            yield f"{name}/{key}", value
        elif isinstance(value, dict) and isinstance(now[key], dict):
            yield from missing(value, now[key], f"{name}/{key}")


def answers(uri):
    """Whether a node accepts a connection; one that is stopped does, too."""
    address = urlsplit(uri)
    try:
        socket.create_connection((address.hostname, address.port), PATIENCE).close()
    except OSError:
        return False
    return True
