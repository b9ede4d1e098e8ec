# SPDX-License-Identifier: Apache-2.0
"""schema_hashes.py FILE: prints name and type hash of each message in a message_schemas.h, by rosbags."""
import re
import sys
from pathlib import Path

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

for name, definition in re.findall(r'MessageSchema\{"([^"]+)", R"msg\((.*?)\)msg"',
                                   Path(sys.argv[1]).read_text(), re.DOTALL):
    types = get_typestore(Stores.EMPTY)
    types.register(get_types_from_msg(definition, name))
    print(name, types.hash_rihs01(name))
