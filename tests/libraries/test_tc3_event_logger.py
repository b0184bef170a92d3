"""Messages and alarms of Tc3_EventLogger against a model of their states."""

import random

from tests.libraries.st_program import run

NUMBERS = random.Random(1998)
NOT_SUPPORTED, NOT_REQUIRED, WAITING, CONFIRMED, RESET = range(5)
STATES = ("NotSupported", "NotRequired", "WaitForConfirmation", "Confirmed", "Reset")


class Alarm:
    """State of an alarm as the manual describes it."""

    def __init__(self, confirmation: bool) -> None:
        self.raised = False
        self.state = NOT_REQUIRED if confirmation else NOT_SUPPORTED

    def do(self, action: str) -> bool:
        """Whether the action changed something."""
        if action == "Raise":
            changed, self.raised = not self.raised, True
            if changed and self.state != NOT_SUPPORTED:
                self.state = WAITING
        elif action == "Confirm":
            changed = self.state == WAITING
            self.state = CONFIRMED if changed else self.state
        else:
            changed, self.raised = self.raised, False
            if changed and action == "ClearAndReset" and self.state == WAITING:
                self.state = RESET
        return changed


def test_alarms_go_through_their_states() -> None:
    alarms = [Alarm(confirmation=True), Alarm(confirmation=False)]
    lines, expected, logged = [], [], []
    kinds = {"Raise": "AlarmRaised", "Confirm": "AlarmConfirmed"}
    for n in range(60):
        number = NUMBERS.randrange(2)
        action = NUMBERS.choice(["Raise", "Raise", "Clear", "ClearAndReset", "Confirm"])
        call = f"Clear({n + 1}, {'TRUE' if action == 'ClearAndReset' else 'FALSE'})"
        if action in kinds:
            call = f"{action}({n + 1})"
        lines.append(f"h[{n}] := a[{number}].{call}; r[{n}] := a[{number}].bRaised;")
        lines.append(f"s[{n}] := a[{number}].eConfirmationState;")
        changed = alarms[number].do(action)
        if changed:
            logged.append((kinds.get(action, "AlarmCleared"), number + 7, n + 1))
        expected.append((0 if changed else 1, alarms[number].raised, alarms[number].state))
    text = f"""
        PROGRAM Main
        VAR
            a : ARRAY[0..1] OF FB_TcAlarm; e : TcEventEntry; logger : FB_TcEventLogger; k : UDINT;
            h : ARRAY[0..59] OF HRESULT; r : ARRAY[0..59] OF BOOL;
            s : ARRAY[0..59] OF TcEventConfirmationState;
            aLog : ARRAY[0..59] OF ST_LoggedEvent; nMissing : HRESULT; xMore : BOOL; stMore : ST_LoggedEvent;
        END_VAR
        nMissing := a[0].Raise(1);
        e.eSeverity := TcEventSeverity.Critical;
        e.nEventId := 7; a[0].CreateEx(e, TRUE); e.nEventId := 8; a[1].CreateEx(e, FALSE);
        {chr(10).join(lines)}
        FOR k := 1 TO {len(logged)} DO
            logger.GetLoggedEvent({len(logged)} - k, stLogged => aLog[k - 1]);
        END_FOR
        xMore := logger.GetLoggedEvent({len(logged)}, stLogged => stMore);
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.h") == str([result for result, _, _ in expected])
        assert program.literal("Main.r") == str([raised for _, raised, _ in expected]).upper()
        assert program.literal("Main.s") == f"[{', '.join(STATES[state] for _, _, state in expected)}]"
        assert program.literal("Main.nMissing") == "-2147467259"
        assert program.literal("Main.xMore") == "FALSE"
        for n, (kind, event, stamp) in enumerate(logged):
            entry = f"Main.aLog[{n}]"
            assert program.literal(f"{entry}.eKind") == kind
            assert program.literal(f"{entry}.stEvent.nEventId") == str(event)
            assert program.literal(f"{entry}.nTimeStamp") == str(stamp)


def test_messages_arguments_and_all_alarms_at_once() -> None:
    text = """
        PROGRAM Main
        VAR
            m : FB_TcMessage; a, b : FB_TcAlarm; logger : FB_TcEventLogger; e, f : TcEventEntry;
            x : ARRAY[0..5] OF BOOL;
            stLast, stOld : ST_LoggedEvent; i : INT; nNotCreated : HRESULT; nArguments : UDINT; y : BOOL;
        END_VAR
        nNotCreated := m.Send(0);
        e.nEventId := 3; e.eSeverity := TcEventSeverity.Warning; e.uuidEventClass.Data1 := 16#1234_5678;
        f := e;
        f.uuidEventClass.Data4[7] := 1;
        m.CreateEx(e, 0); m.ipArguments.Clear().AddInt(-5).AddString('Oven').AddLReal(2.5).AddBool(TRUE);
        nArguments := m.ipArguments.Count(); m.Send(77); y := logger.GetLoggedEvent(0, stLogged => stLast);
        x[0] := m.EqualsToEventEntryEx(e); x[1] := m.EqualsToEventEntryEx(f);
        a.CreateEx(e, TRUE, 0); b.CreateEx(f, TRUE, 0); a.Raise(0);
        x[2] := logger.IsAlarmRaisedEx(e); x[3] := logger.IsAlarmRaisedEx(f);
        b.Raise(0); logger.ConfirmAllAlarms(0); logger.ClearAllAlarms(0, TRUE);
        x[4] := logger.IsAlarmRaisedEx(e) OR logger.IsAlarmRaisedEx(f);
        x[5] := a.eConfirmationState = TcEventConfirmationState.Confirmed;
        FOR i := 1 TO 150 DO m.Send(INT_TO_ULINT(1000 + i)); END_FOR
        y := logger.GetLoggedEvent(99, stLogged => stOld);
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.nNotCreated") == "-2147467259"
        assert program.literal("Main.nArguments") == "4"
        assert program.literal("Main.stLast.sArguments") == "'-5,Oven,2.5,TRUE'"
        assert program.literal("Main.stLast.nTimeStamp") == "77"
        assert program.literal("Main.x") == "[TRUE, FALSE, TRUE, FALSE, FALSE, TRUE]"
        assert program.literal("Main.stOld.nTimeStamp") == "1051"


def test_events_by_their_parts_and_texts_that_are_not_known() -> None:
    text = """
        PROGRAM Main
        VAR
            m : FB_TcMessage; a : FB_TcAlarm; e : TcEventEntry; x : ARRAY[0..4] OF BOOL;
            s : STRING := 'before'; h : HRESULT; nId : UDINT; y : BOOL;
            stLast, stSent : ST_LoggedEvent; logger : FB_TcEventLogger; fbArguments : FB_TcArguments;
            now : BOOL;
        END_VAR
        e.uuidEventClass.Data1 := 5; e.nEventId := 9; e.eSeverity := TcEventSeverity.Error;
        m.Create(e.uuidEventClass, 9, TcEventSeverity.Error, 0);
        a.Create(e.uuidEventClass, 9, TcEventSeverity.Error, TRUE, 0);
        x[0] := m.EqualsToEventEntryEx(e) AND a.EqualsToEventEntryEx(e);
        x[1] := m.EqualsToEventEntry(e.uuidEventClass, 9, TcEventSeverity.Error);
        x[2] := m.EqualsToEventEntry(e.uuidEventClass, 9, TcEventSeverity.Warning);
        x[3] := m.RequestEventText(1033, s, SIZEOF(s), bError => x[4], hrErrorCode => h);
        nId := m.EventClass.Data1; m.Send(3); y := logger.GetLoggedEvent(0, stLogged => stLast);
        fbArguments.AddInt(4).AddString('Oven');
        logger.SendMessageEx(e, 0, 0, fbArguments); y := logger.GetLoggedEvent(0, stLogged => stSent);
        now := stSent.nTimeStamp = 134_344_736_000_000_000 + LTIME_TO_ULINT(LTIME()) / 100;
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.x") == "[TRUE, TRUE, FALSE, TRUE, TRUE]"
        assert program.literal("Main.s") == "''"
        assert program.literal("Main.h") == str(0x9811070C - 2**32)
        assert program.literal("Main.nId") == "5"
        assert program.literal("Main.stLast.stEvent.nEventId") == "9"
        assert program.literal("Main.stSent.sArguments") == "'4,Oven'"
        assert program.literal("Main.now") == "TRUE"
