"""A reader of event files that shares nothing with the writer: checks bit by bit, messages field by field."""

import struct


def crc32c(data):
    """Castagnoli's check, by division of polynomials."""
    remainder = 0xFFFFFFFF
    for byte in data:
        for bit in range(8):
            odd = (remainder ^ (byte >> bit)) & 1
            remainder >>= 1
            if odd:
                remainder ^= int(f"{0x1EDC6F41:032b}"[::-1], 2)
    return remainder ^ 0xFFFFFFFF


def unmasked(number):
    rotated = (number - 0xA282EAD8) % 2**32
    return ((rotated << 15) | (rotated >> 17)) % 2**32


def records(content):
    """The data of each record, after their checks."""
    place = 0
    while place < len(content):
        (length,) = struct.unpack_from("<Q", content, place)
        data = content[place + 12 : place + 12 + length]
        assert unmasked(*struct.unpack_from("<I", content, place + 8)) == crc32c(content[place : place + 8])
        assert unmasked(*struct.unpack_from("<I", content, place + 12 + length)) == crc32c(data)
        yield data
        place += 16 + length


def fields(message):
    """The number and value of each field of a message of protocol buffers."""
    place = 0

    def varint():
        nonlocal place
        value = shift = 0
        while True:
            byte = message[place]
            place += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    while place < len(message):
        number, kind = divmod(varint(), 8)
        if kind == 0:
            yield number, varint()
        elif kind == 2:
            size = varint()
            yield number, bytes(message[place : place + size])
            place += size
        else:
            size, form = {1: (8, "<d"), 5: (4, "<f")}[kind]
            yield number, struct.unpack_from(form, message, place)[0]
            place += size


def scalars(content):
    """By tag the steps and the values, and the file's version."""
    version, found = None, {}
    for data in records(content):
        event = dict(fields(data))
        version = event.get(3, version)
        for number, value in fields(event.get(5, b"")):
            assert number == 1
            parts = dict(fields(value))
            found.setdefault(parts[1].decode(), []).append((event[2], parts[2]))
    return version, found
