"""Files that are no ontology by their name, their size or their bytes."""

import pytest

from casper.kb.errors import DomainError, ReadError
from casper.kb.ontologies.importing import import_ontologies

MIB = 2**20


def test_a_file_beyond_256_mib_is_refused_unread(tmp_path):
    file = tmp_path / "zoo.ofn"
    with file.open("wb") as stream:
        stream.truncate(256 * MIB + 1)
    with pytest.raises(DomainError, match="is larger than 256 MiB; split it"):
        import_ontologies([file])


@pytest.mark.parametrize("name", ["zoo.txt", "zoo", "zoo.pl"])
def test_a_file_of_another_suffix_is_refused_with_those_that_there_are(name, tmp_path):
    (tmp_path / name).write_text("Ontology()")
    with pytest.raises(DomainError, match=r"no ontology by its name; files end in .*\.owl.*\.ttl.*\.ofn"):
        import_ontologies([tmp_path / name])


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(DomainError, match=r"cannot read .*zoo\.ttl"):
        import_ontologies([tmp_path / "zoo.ttl"])


def test_bytes_that_are_no_utf_8_are_told_with_their_line(tmp_path):
    file = tmp_path / "zoo.ofn"
    file.write_bytes(b"Ontology(\n# caf\xe9\n)")
    with pytest.raises(ReadError, match="this is no UTF-8; save the file as UTF-8") as told:
        import_ontologies([file])
    assert told.value.place.line == 2


def test_nothing_is_made_of_files_that_cannot_all_be_read(tmp_path):
    (tmp_path / "a.ofn").write_text("Ontology(ClassAssertion(<urn:Dog> <urn:rex>))")
    (tmp_path / "b.ofn").write_text("Ontology(")
    with pytest.raises(ReadError) as told:
        import_ontologies([tmp_path / "a.ofn", tmp_path / "b.ofn"])
    assert told.value.place.file == str(tmp_path / "b.ofn")


def test_what_was_written_is_replaced_only_when_asked(tmp_path):
    (tmp_path / "a.ofn").write_text("Ontology(ClassAssertion(<urn:Dog> <urn:rex>))")
    found = import_ontologies([tmp_path / "a.ofn"])
    assert found.write(tmp_path / "out") == []
    with pytest.raises(DomainError, match="is there already; choose another folder, or write --replace"):
        found.write(tmp_path / "out")
    assert found.write(tmp_path / "out", replace=True) == []
    assert (tmp_path / "out" / "ontology.pl").read_text(encoding="utf-8") == found.files["ontology.pl"]
