"""Gives a result that was changed right digests again, as docs/file-format.md defines them: what a stranger can do."""

import hashlib

import h5py
import numpy

TYPES = {"<f8": "f64", "<i8": "i64", "<u8": "u64", "<u4": "u32", "|u1": "u8"}


def sha256(content):
    return hashlib.sha256(content).hexdigest()


def line_of(path, value):
    """That of a dataset or an attribute; none for what counts in no digest."""
    if h5py.check_string_dtype(value.dtype):
        texts = [text if isinstance(text, bytes) else text.encode() for text in value.reshape(-1).tolist()]
        content = b"".join(len(text).to_bytes(8, "little") + text for text in texts)
        return f"{path} text {'x'.join(map(str, value.shape))} {sha256(content)}\n"
    if value.dtype.str not in TYPES:
        return ""
    shape = "x".join(map(str, value.shape))
    return f"{path} {TYPES[value.dtype.str]} {shape} {sha256(numpy.ascontiguousarray(value).tobytes())}\n"


def attribute_of(object, name):
    identifier = h5py.h5a.open(object.id, name.encode())
    kind = identifier.get_type()
    if not isinstance(kind, h5py.h5t.TypeStringID):
        return numpy.atleast_1d(numpy.asarray(object.attrs[name]))
    if not kind.is_variable_str():
        return None
    texts = object.attrs[name]
    if isinstance(texts, h5py.Empty):
        texts = []
    return numpy.asarray([texts] if isinstance(texts, str) else list(texts), dtype=h5py.string_dtype())


def mend(path):
    """Writes the digests that the file has now."""
    with h5py.File(path, "r+") as file:
        datasets, attributes = {}, []

        def note(name, object):
            if isinstance(object, h5py.Dataset) and not name.startswith("provenance/"):
                datasets[f"/{name}"] = line_of(f"/{name}", object[...])
            if name.split("/")[0] != "trials":
                attributes.extend((f"/{name}@{key}", attribute_of(object, key)) for key in object.attrs)

        file.visititems(note)
        attributes.extend((f"/@{key}", attribute_of(file, key)) for key in file.attrs if not key.endswith("_sha256"))
        lines = [datasets[name] for name in sorted(datasets, key=str.encode)]
        totals = [datasets[name] for name in sorted(datasets, key=str.encode) if not name.startswith("/trials/")]
        of_attributes = sorted({line_of(name, value) for name, value in attributes if value is not None}, key=str.encode)
        for name, of in (("data", lines), ("totals", totals), ("attributes", of_attributes)):
            file.attrs.modify(f"{name}_sha256", sha256("".join(of).encode()))
