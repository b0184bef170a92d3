"""CSV records, ring buffers, hash tables and lists of Tc2_Utilities against Python's own."""

import csv
import io
import random
from collections import deque

from tests.libraries.st_program import run

NUMBERS = random.Random(1492)


def _literal(text: str) -> str:
    return "'" + text.replace("$", "$$").replace("'", "$'").replace("\r", "$R").replace("\n", "$N") + "'"


def test_csv_records_are_those_of_python() -> None:
    words = ["", "plain", 'say "so"', "a;b", "two\r\nlines", "it's $5", "  blanks "]
    rows = [[NUMBERS.choice(words) for _ in range(NUMBERS.randint(1, 4))] for _ in range(6)]
    expected = io.StringIO()
    csv.writer(expected, delimiter=";", lineterminator="\r\n", quoting=csv.QUOTE_ALL).writerows(rows)
    lines, fields = [], [(field, k == len(row) - 1) for row in rows for k, field in enumerate(row)]
    for n, (field, last) in enumerate(fields):
        command = "eEnumCmd_Next" if n else "eEnumCmd_First"
        lines.append(f"w(eCmd := {command}, putValue := STRING_TO_CSVFIELD({_literal(field)}, TRUE), ")
        lines.append(f"  bCRLF := {str(last).upper()}, pBuffer := ADR(aText), cbBuffer := SIZEOF(aText));")
    text = f"""
        PROGRAM Main
        VAR
            w : FB_CSVMemBufferWriter; rd : FB_CSVMemBufferReader; n : INT;
            aText : ARRAY[0..1999] OF BYTE;
            aField : ARRAY[0..30] OF STRING(80); aEnd : ARRAY[0..30] OF BOOL;
        END_VAR
        {"".join(lines)}
        rd(eCmd := eEnumCmd_First, pBuffer := ADR(aText), cbBuffer := w.cbSize);
        WHILE rd.bOk DO
            aField[n] := CSVFIELD_TO_STRING(rd.getValue, TRUE);
            aEnd[n] := rd.bCRLF;
            n := n + 1;
            rd(eCmd := eEnumCmd_Next, pBuffer := ADR(aText), cbBuffer := w.cbSize);
        END_WHILE
        END_PROGRAM"""
    with run(text, 1) as program:
        size = int(program.literal("Main.w.cbSize"))
        written = bytes(int(byte) for byte in program.numbers("Main.aText")[:size])
        assert written.decode() == expected.getvalue()
        assert program.literal("Main.w.nRecords") == str(len(rows))
        assert program.literal("Main.n") == program.literal("Main.w.nFields") == str(len(fields))
        for n, (field, last) in enumerate(fields):
            assert program.literal(f"Main.aField[{n}]") == _literal(field)
            assert program.literal(f"Main.aEnd[{n}]") == str(last).upper()
        assert program.literal("Main.rd.cbRead") == str(size)
        assert program.literal("Main.w.cbFree") == str(2000 - size)
        assert program.literal("Main.w.cbWrite") == str(len(_field(*fields[-1])) + (len(rows[-1]) > 1))


def _field(text: str, last: bool) -> bytes:
    """A field as it is written, with the end of its record."""
    return ('"' + text.replace('"', '""') + '"' + "\r\n" * last).encode()


def test_csv_without_room_and_without_an_end() -> None:
    text = """
        PROGRAM Main
        VAR
            w : FB_CSVMemBufferWriter; rd : FB_CSVMemBufferReader;
            a : ARRAY[0..5] OF BYTE; n : DWORD := 9;
            x : ARRAY[0..4] OF BOOL; s : STRING(255); i : INT; sOut : STRING(255);
        END_VAR
        w(eCmd := eEnumCmd_First, putValue := 'abcd', bCRLF := TRUE, pBuffer := ADR(a), cbBuffer := 6);
        x[0] := w.bOk;
        w(eCmd := eEnumCmd_Next, putValue := '', bCRLF := TRUE, pBuffer := ADR(a), cbBuffer := 6);
        x[1] := w.bOk;
        rd(eCmd := eEnumCmd_First, pBuffer := ADR(a), cbBuffer := 5); x[2] := rd.bOk;
        rd(eCmd := eEnumCmd_First, pBuffer := ADR(a), cbBuffer := 6); x[3] := rd.bOk;
        a[0] := 59; rd(eCmd := eEnumCmd_First, pBuffer := ADR(a), cbBuffer := 6);
        x[4] := rd.bOk AND rd.pValue = 0 AND rd.cbValue = 0 AND rd.cbRead = 1;
        FOR i := 0 TO 253 DO s[i] := 65; END_FOR
        sOut := STRING_TO_CSVFIELD(s, TRUE);
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.x") == "[TRUE, FALSE, FALSE, TRUE, TRUE]"
        assert program.literal("Main.n") == "9"
        assert program.literal("Main.sOut") == "''"


def test_fields_of_any_bytes_and_quotation_marks() -> None:
    text = """
        PROGRAM Main
        VAR
            s : ARRAY[0..6] OF STRING; aRaw : ARRAY[0..4] OF BYTE := [1, 34, 0, 34, 2];
            aBack : ARRAY[0..4] OF BYTE; aField : ARRAY[0..9] OF BYTE; n : ARRAY[0..5] OF UDINT;
            sText : STRING;
        END_VAR
        s[0] := STRING_TO_CSVFIELD('a"b', FALSE); s[1] := STRING_TO_CSVFIELD('a"b', TRUE);
        s[2] := CSVFIELD_TO_STRING('a""b', FALSE); s[3] := CSVFIELD_TO_STRING('"a""b"', TRUE);
        s[4] := CSVFIELD_TO_STRING('"', TRUE); s[5] := STRING_TO_CSVFIELD('', TRUE);
        s[6] := CSVFIELD_TO_STRING('plain', TRUE);
        n[0] := ARG_TO_CSVFIELD(F_BIGTYPE(ADR(aRaw), SIZEOF(aRaw)), TRUE, ADR(aField), SIZEOF(aField));
        n[1] := CSVFIELD_TO_ARG(ADR(aField), n[0], TRUE, F_BIGTYPE(ADR(aBack), SIZEOF(aBack)));
        n[2] := ARG_TO_CSVFIELD(F_BIGTYPE(ADR(aRaw), SIZEOF(aRaw)), TRUE, ADR(aField), 8);
        n[3] := CSVFIELD_TO_ARG(ADR(aField), n[0], TRUE, F_BIGTYPE(ADR(aBack), 4));
        sText := 'x"y'; n[4] := ARG_TO_CSVFIELD(F_STRING(sText), FALSE, ADR(aField), SIZEOF(aField));
        n[5] := CSVFIELD_TO_ARG(ADR(aField), 3, FALSE, F_STRING(sText));
        END_PROGRAM"""
    with run(text, 1) as program:
        fields = [program.literal(f"Main.s[{k}]") for k in range(7)]
        assert fields == ["'a\"\"b'", '\'"a""b"\'', "'a\"b'", "'a\"b'", "'\"'", "'\"\"'", "'plain'"]
        assert program.literal("Main.n") == "[9, 5, 0, 0, 4, 2]"
        assert program.literal("Main.aBack") == "[1, 34, 0, 34, 2]"
        assert program.literal("Main.sText") == "'x\"'"


def test_a_ring_buffer_of_texts_is_a_queue() -> None:
    room, queue, lines, expected = 64, deque[str](), [], []
    for n in range(80):
        free = room - sum(len(word) + 5 for word in queue)
        if NUMBERS.random() < 0.6:
            word, overwrite = "x" * NUMBERS.randrange(20) + str(n), NUMBERS.random() < 0.3
            lines.append(
                f"fb.putValue := '{word}'; fb.bOverwrite := {str(overwrite).upper()}; fb.A_AddTail();"
            )
            while overwrite and len(word) + 5 > room - sum(len(w) + 5 for w in queue):
                queue.popleft()
            free = room - sum(len(w) + 5 for w in queue)
            done, head = len(word) + 5 <= free, ""
            if done:
                queue.append(word)
        else:
            action = NUMBERS.choice(["A_GetHead", "A_RemoveHead"])
            lines.append(f"fb.{action}();")
            done, head = bool(queue), queue[0] if queue else ""
            if done and action == "A_RemoveHead":
                queue.popleft()
        lines.append(f"ok[{n}] := fb.bOk; c[{n}] := fb.nCount; s[{n}] := fb.getValue;")
        expected.append((done, len(queue), head))
    text = f"""
        PROGRAM Main
        VAR
            fb : FB_StringRingBuffer; aRoom : ARRAY[0..{room - 1}] OF BYTE;
            ok : ARRAY[0..79] OF BOOL; c : ARRAY[0..79] OF UDINT; s : ARRAY[0..79] OF STRING(30);
        END_VAR
        fb.pBuffer := ADR(aRoom); fb.cbBuffer := SIZEOF(aRoom); fb.A_Reset();
        {" ".join(lines)}
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.ok") == str([done for done, _, _ in expected]).upper()
        assert program.literal("Main.c") == str([count for _, count, _ in expected])
        assert program.literal("Main.s") == str([head for _, _, head in expected])


def test_a_ring_buffer_shows_its_records_where_they_lie() -> None:
    room, queue, lines, expected = 61, deque[list[int]](), [], []
    for n in range(120):
        if NUMBERS.random() < 0.55:
            record = [NUMBERS.randrange(256) for _ in range(NUMBERS.randint(1, 20))]
            values = " ".join(f"aData[{k}] := {byte};" for k, byte in enumerate(record))
            lines.append(f"fb.A_GetFreeSize(); nFit := fb.cbFree; {values} fb.cbWrite := {len(record)};")
            lines.append(f"fb.A_AddTail(); wrong := wrong OR fb.bOk <> (nFit >= {len(record) + 4});")
            lines.append(f"added[{n}] := fb.bOk;")
            expected.append(("add", record))
        else:
            action = NUMBERS.choice(["A_GetHead", "A_FreeHead"])
            lines.append("fb.A_GetHead(); sum := fb.cbRead; i := 0;")
            lines.append("WHILE i < fb.cbRead DO sum := sum * 31 + fb.pRead[i]; i := i + 1; END_WHILE")
            lines.append(f"sums[{n}] := sum; fb.{action}(); added[{n}] := fb.bOk;")
            expected.append((action, []))
    text = f"""
        PROGRAM Main
        VAR
            fb : FB_MemRingBufferEx; aRoom : ARRAY[0..{room - 1}] OF BYTE; aData : ARRAY[0..19] OF BYTE;
            added : ARRAY[0..119] OF BOOL; sums : ARRAY[0..119] OF UDINT; sum, i, nFit : UDINT; wrong : BOOL;
            nEmpty : UDINT;
        END_VAR
        fb.pBuffer := ADR(aRoom); fb.cbBuffer := SIZEOF(aRoom); fb.pWrite := ADR(aData); fb.A_Reset();
        fb.A_GetFreeSize(); nEmpty := fb.cbFree;
        {" ".join(lines)}
        END_PROGRAM"""
    with run(text, 1) as program:
        done = program.literal("Main.added").strip("[]").split(", ")
        sums = program.literal("Main.sums").strip("[]").split(", ")
        refused = 0
        for n, (action, record) in enumerate(expected):
            if action == "add":
                if done[n] == "TRUE":
                    queue.append(record)
                refused += done[n] == "FALSE"
                continue
            assert (done[n] == "TRUE") == bool(queue)
            total = len(queue[0]) if queue else 0
            for byte in queue[0] if queue else []:
                total = (total * 31 + byte) % 2**32
            assert int(sums[n]) == total
            if queue and action == "A_FreeHead":
                queue.popleft()
        assert refused
        assert program.literal("Main.wrong") == "FALSE"
        assert program.literal("Main.nEmpty") == str(room)
        assert program.literal("Main.fb.nCount") == str(len(queue))
        assert program.literal("Main.fb.cbSize") == str(sum(len(record) + 4 for record in queue))


def test_a_hash_table_is_a_dictionary() -> None:
    size, table, lines, expected = 7, dict[int, int](), [], []
    for n in range(100):
        key, value = NUMBERS.choice([1, 8, 15, 22, 3, 10, 5, 0, 4294967295, 12]), NUMBERS.randrange(10**6)
        kind = NUMBERS.choice(["A_Add", "A_Add", "A_Lookup", "A_Remove"])
        lines.append(f"fb.{kind}(hTable := h, key := {key}, putValue := {value}, bOk => ok[{n}]); ")
        lines.append(f"v[{n}] := TO_UDINT(fb.getValue); c[{n}] := h.nCount;")
        if kind == "A_Add":
            done = key in table or len(table) < size
            if done:
                table[key] = value
            answer = value if done else 0
        else:
            done, answer = key in table, table.get(key, 0)
            if kind == "A_Remove":
                table.pop(key, None)
        expected.append((done, answer, len(table)))
    text = f"""
        PROGRAM Main
        VAR
            fb : FB_HashTableCtrl; h : T_HHASHTABLE; aRoom : ARRAY[0..{size - 1}] OF T_HashTableEntry;
            ok : ARRAY[0..99] OF BOOL; v, c : ARRAY[0..99] OF UDINT; nSum, nElements : UDINT; x : BOOL;
        END_VAR
        x := F_CreateHashTableHnd(ADR(aRoom), SIZEOF(aRoom), h);
        {" ".join(lines)}
        fb.A_GetFirst(hTable := h);
        WHILE fb.bOk DO
            nSum := nSum + TO_UDINT(fb.getValue); nElements := nElements + 1;
            fb.A_GetNext(hTable := h, putPosPtr := fb.getPosPtr);
        END_WHILE
        fb.A_RemoveAll(hTable := h);
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.ok") == str([done for done, _, _ in expected]).upper()
        assert program.literal("Main.v") == str([answer for _, answer, _ in expected])
        assert program.literal("Main.c") == str([count for _, _, count in expected])
        assert program.literal("Main.nElements") == str(len(table))
        assert program.literal("Main.nSum") == str(sum(table.values()))
        assert (program.literal("Main.h.nCount"), program.literal("Main.h.nFree")) == ("0", str(size))


def test_a_linked_list_is_a_list() -> None:
    size, values, lines, expected = 9, list[int](), [], []
    for n in range(100):
        value = NUMBERS.randrange(6)
        kind = NUMBERS.choice(["AddHeadValue", "AddTailValue", "RemoveHeadValue", "RemoveTailValue", "find"])
        done, answer = bool(values), 0
        if kind == "find":
            lines.append(f"fb.A_FindNext(hList := h, putPosPtr := 0, putValue := {value}); x := fb.bOk;")
            lines.append("IF x THEN fb.A_RemoveValueAtPosPtr(hList := h, putPosPtr := fb.getPosPtr); END_IF")
            done = value in values
            if done:
                values.remove(value)
                answer = value
        else:
            lines.append(f"fb.A_{kind}(hList := h, putValue := {value});")
            if kind.startswith("Add"):
                done = len(values) < size
                if done:
                    values.insert(0 if kind == "AddHeadValue" else len(values), value)
                    answer = value
            elif done:
                answer = values.pop(0 if kind == "RemoveHeadValue" else -1)
        lines.append(f"ok[{n}] := fb.bOk; v[{n}] := TO_UDINT(fb.getValue); c[{n}] := h.nCount;")
        expected.append((done, answer, len(values)))
    text = f"""
        PROGRAM Main
        VAR
            fb : FB_LinkedListCtrl; h : T_HLINKEDLIST; aRoom : ARRAY[0..{size - 1}] OF T_LinkedListEntry;
            ok : ARRAY[0..99] OF BOOL; v, c : ARRAY[0..99] OF UDINT; i : INT; x : BOOL;
            aAhead, aBack : ARRAY[0..8] OF UDINT;
        END_VAR
        x := F_CreateLinkedListHnd(ADR(aRoom), SIZEOF(aRoom), h);
        {" ".join(lines)}
        fb.A_GetHead(hList := h);
        WHILE fb.bOk DO
            aAhead[i] := TO_UDINT(fb.getValue); i := i + 1;
            fb.A_GetNext(hList := h, putPosPtr := fb.getPosPtr);
        END_WHILE
        i := 0; fb.A_GetTail(hList := h);
        WHILE fb.bOk DO
            aBack[i] := TO_UDINT(fb.getValue); i := i + 1;
            fb.A_GetPrev(hList := h, putPosPtr := fb.getPosPtr);
        END_WHILE
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.ok") == str([done for done, _, _ in expected]).upper()
        assert program.literal("Main.v") == str([answer for _, answer, _ in expected])
        assert program.literal("Main.c") == str([count for _, _, count in expected])
        filled = values + [0] * (size - len(values))
        assert program.literal("Main.aAhead") == str(filled)
        assert program.literal("Main.aBack") == str(values[::-1] + [0] * (size - len(values)))
