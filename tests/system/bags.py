"""ROS 2 bags of what a real robot says, made of recordings by rosbags."""

from mcap.reader import make_reader
from rosbags.rosbag2 import CompressionFormat, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

TOPICS = ("/lowstate", "/lowcmd")


def messages_of(path, topics):
    with open(path, "rb") as file:
        yield from make_reader(file).iter_messages(topics=topics)


def bag_of(recording, folder, storage=StoragePlugin.SQLITE3, packed=None, topics=TOPICS):
    """What a real robot's bag has: these topics, nothing of the simulation's."""
    store = get_typestore(Stores.EMPTY)
    writer = Writer(folder, version=9, storage_plugin=storage)
    if packed is not None:
        writer.set_compression(packed, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for schema, channel, message in messages_of(recording, topics):
            if channel.topic not in connections:
                store.register({name: one for name, one in get_types_from_msg(schema.data.decode(), schema.name).items()
                                if name not in store.types})
                connections[channel.topic] = writer.add_connection(channel.topic, schema.name, typestore=store)
            writer.write(connections[channel.topic], message.log_time, message.data)
    return folder
