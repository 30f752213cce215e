# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The folder of kept pieces is a help and never a fault: altered files are made anew, an unwritable
folder costs time only."""

import io
import os
import stat
import tempfile
import warnings

import numpy as np
import pytest

import ofg
from ofg import Body, piecefile, wholefile

HULLS = [np.arange(12.0).reshape(4, 3), np.arange(15.0).reshape(5, 3)]
CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@pytest.fixture
def mesh(tmp_path, monkeypatch):
    """A cube as a mesh, whose pieces are kept in tmp_path/pieces."""
    monkeypatch.setenv("OFG_CACHE", str(tmp_path / "pieces"))
    monkeypatch.setattr(piecefile, "_kept_here", {})
    return Body.mesh(CUBE, Body.convex(CUBE).faces, "cube")


def test_every_cut_and_every_altered_byte_is_found():
    """A zip archive has checksums of its own, but not of all of it, and numpy does not look."""
    whole = piecefile.packed(HULLS)
    assert all(np.array_equal(a, b) for a, b in zip(piecefile.unpacked(whole), HULLS, strict=True))
    for n in range(0, len(whole) - 1, 7):
        assert piecefile.unpacked(whole[:n]) is None
    for n in range(0, len(whole), 5):
        altered = bytearray(whole)
        altered[n] ^= 0x55
        read = piecefile.unpacked(bytes(altered))
        assert read is None or all(np.array_equal(a, b) for a, b in zip(read, HULLS, strict=True))


def test_other_numbers_in_a_sound_archive_are_made_anew(mesh):
    """Whatever archive lay under the name was taken: a cube came back at half the size."""
    made = ofg.decompose(mesh)
    (file,) = ofg.decomposition.cache_folder().iterdir()
    stream = io.BytesIO()
    np.savez(stream, vertices=CUBE / 2, splits=np.empty(0, np.int64))
    file.write_bytes(stream.getvalue())
    assert ofg.decompose(mesh).digest == made.digest
    assert piecefile.unpacked(file.read_bytes()) is not None, "the file is sound again"


def test_what_is_kept_may_be_read_by_others(mesh):
    """Temporary files are made for their owner alone, and keep that when they are renamed."""
    before = os.umask(0o022)
    try:
        ofg.decompose(mesh)
    finally:
        os.umask(before)
    (file,) = ofg.decomposition.cache_folder().iterdir()
    assert stat.S_IMODE(file.stat().st_mode) == 0o644


def test_a_folder_that_cannot_be_written_costs_one_warning(mesh, tmp_path, monkeypatch):
    """It was an error of the engine. A file in the folder's place stops root too."""
    (tmp_path / "pieces").write_text("a file")
    asked, real = [], ofg.decomposition._coacd
    monkeypatch.setattr(ofg.decomposition, "_coacd", lambda *a: asked.append(1) or real(*a))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("default")
        assert ofg.decompose(mesh).volume == pytest.approx(8)
        assert ofg.decompose(mesh).volume == pytest.approx(8)
    assert len(asked) == 1, "the process remembers"
    (one,) = said
    assert "changes no answer" in str(one.message) and "OFG_CACHE" in str(one.message)
    assert "OFG_CACHE" in piecefile.fault(tmp_path / "pieces")
    assert piecefile.fault(tmp_path / "elsewhere") is None


def test_decomposing_needs_no_folder_of_temporary_files(mesh, monkeypatch):
    """A full TMPDIR was an error of the engine, and a kill left a folder there."""

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", full)
    monkeypatch.setattr(tempfile, "NamedTemporaryFile", full)
    assert ofg.decompose(mesh).volume == pytest.approx(8)


def test_temporary_files_of_killed_writers_go_and_those_of_others_stay(tmp_path):
    killed, other, mine = tmp_path / "a.npz", tmp_path / "b.npz", tmp_path / "thesis.unfinished"
    for path in (killed, other):
        path.write_bytes(b"")
    killed = killed.rename(wholefile.temporary_of(killed))
    other = other.rename(wholefile.temporary_of(other))
    mine.write_text("a reader's own")
    os.utime(killed, (0, 0))
    piecefile.store(tmp_path / "c.npz", HULLS)
    assert not killed.exists() and other.exists() and mine.exists()


def test_a_write_that_fails_leaves_the_old_file_and_no_other(tmp_path):
    path = tmp_path / "a"
    path.write_text("old")

    def fill(temporary):
        temporary.write_text("half")
        raise OSError(28, "No space left on device")

    with pytest.raises(OSError):
        wholefile.write(path, fill)
    assert path.read_text() == "old" and list(tmp_path.iterdir()) == [path]
