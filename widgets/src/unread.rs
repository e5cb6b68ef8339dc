//! Why a log cannot be read, and what was made of it, in the language spoken. The reader of logs tells it as data. It displays them in English
//! too, which nothing here asks of it: with that, std's writing of floating-point numbers would come into the program.

use crate::decimal;
use crate::model::FigureError;
use crate::words::{log, unread as words};
use fastslam::mapper;
use fastslam_log::{Beyond, Field, LaserLog, LogError, LogProblem, MessageProblem, Remark, Topics};

/// A file that is refused.
pub fn refused(message: impl Into<String>) -> FigureError {
    FigureError { parameter: "file".into(), message: message.into() }
}

/// What is wrong with a file, in a line.
pub fn error(LogError { line, problem }: &LogError) -> FigureError {
    let problem = self::problem(problem);
    refused(if *line > 0 { log::AtLine { line, message: &problem }.say() } else { problem })
}

/// A log of text, read by one of the parsers of [`fastslam_log`].
///
/// # Errors
/// What is wrong with it, for whoever chose the file.
pub fn text(file: &[u8], parse: impl Fn(&[u8], bool) -> Result<LaserLog, LogError>) -> Result<LaserLog, FigureError> {
    // Without its malformed lines first, to count them. Where nothing is left, the first of them tells most.
    parse(file, true).map_err(|_| match parse(file, false) {
        Err(why) => error(&why),
        Ok(_) => refused(log::no_scan()),
    })
}

/// A problem of a log.
pub fn problem(problem: &LogProblem) -> String {
    match problem {
        LogProblem::LongLine => words::long_line().into(),
        LogProblem::Binary => words::binary().into(),
        LogProblem::UnknownMessage(found) => words::UnknownMessage { found }.say(),
        LogProblem::NoMessage(found) => words::NoMessage { found }.say(),
        LogProblem::Field { message, field: what, found } => words::Field {
            message: &message.unwrap_or_else(|| words::a_pose()),
            field: &field(*what),
            found: &found.as_deref().unwrap_or_else(|| words::end_of_line()),
        }
        .say(),
        LogProblem::NoRanges { message } => words::NoRanges { message }.say(),
        LogProblem::OtherRanges { message, before, found } => words::OtherRanges { message, before, found }.say(),
        LogProblem::Angles { message, first, step } => {
            words::Angles { message, first: &number(*first), step: &number(*step) }.say()
        }
        LogProblem::Jump { message, kilometres } => words::Jump { message, kilometres: &tenths(*kilometres) }.say(),
        LogProblem::Far { message, names, found } => {
            let found = found.map(number).join(" ");
            words::Far { message, names, found: &found }.say()
        }
        LogProblem::NoPose => words::no_pose().into(),
        LogProblem::Json(why) => words::Json { why }.say(),
        LogProblem::JsonLacks(name) => words::JsonLacks { name }.say(),
        LogProblem::JsonAngles { first, step } => {
            words::JsonAngles { first: &number(*first), step: &number(*step) }.say()
        }
        LogProblem::JsonNoRanges => words::json_no_ranges().into(),
        LogProblem::JsonFar => words::json_far().into(),
        LogProblem::NoScan { but: other } => words::NoScan { but: &but(other.as_ref()) }.say(),
        LogProblem::NoScanSoon { megabytes, but: other } => {
            words::NoScanSoon { megabytes, but: &but(other.as_ref()) }.say()
        }
        LogProblem::NoReading { readings, beyond: Beyond { count: 0, .. } } => words::NoReading { readings }.say(),
        LogProblem::NoReading { readings, beyond: Beyond { count, shortest, max_range } } => {
            let [max_range, shortest] = [max_range, shortest].map(|metres| tenths(f64::from(*metres)));
            words::AllBeyond { readings, beyond: count, max_range: &max_range, shortest: &shortest }.say()
        }
        LogProblem::NoCommonTime { scans, odometry } => {
            let ([first, last], [begin, end]) = (scans.map(milliseconds), odometry.map(milliseconds));
            words::NoCommonTime { first: &first, last: &last, begin: &begin, end: &end }.say()
        }
        LogProblem::OdometryJumps { kilometres, time } => {
            words::OdometryJumps { kilometres: &tenths(*kilometres), time: &milliseconds(*time) }.say()
        }
        LogProblem::NoBag => words::no_bag().into(),
        LogProblem::OldBag => words::old_bag().into(),
        LogProblem::NoScanTopic(found) => words::NoScanTopic { topics: &topics(found) }.say(),
        LogProblem::Tilted { laser, robot } => words::Tilted { laser, robot }.say(),
        LogProblem::Message { topic, number, kind, problem } => {
            words::Message { topic, number, kind, problem: &of_message(problem) }.say()
        }
        LogProblem::Truncated => words::truncated().into(),
        LogProblem::Compression(name) => words::Compression { name }.say(),
        LogProblem::Damaged(what) => words::Damaged { what }.say(),
        LogProblem::Topic(told) | LogProblem::Told(told) => told.clone(),
        _ => words::other().into(),
    }
}

/// What was made of a log that does not tell all.
pub fn remark(remark: &Remark) -> String {
    match remark {
        Remark::NoOdometry => words::no_odometry().into(),
        Remark::StillOdometry => words::still_odometry().into(),
        Remark::HeadingsInDegrees => words::headings_in_degrees().into(),
        Remark::SomeHeadingsInDegrees { from, to } => {
            words::SomeHeadingsInDegrees { from: &milliseconds(*from), to: &milliseconds(*to) }.say()
        }
        Remark::ClockSetBack { seconds, time } => {
            words::ClockSetBack { seconds: &tenths(*seconds), time: &milliseconds(*time) }.say()
        }
        Remark::Copied { stretch: [[first, last], [from, to]], count } => {
            words::Copied { count, first, last, from, to }.say()
        }
        Remark::Beyond(scans) => words::Beyond { scans }.say(),
        Remark::NoTransform { laser, robot } => words::NoTransform { laser, robot }.say(),
        Remark::Told(told) => told.clone(),
        _ => words::other().into(),
    }
}

/// What one does not see at once of a path and a map.
pub fn mapped(remark: &mapper::Remark) -> String {
    use mapper::Remark;
    match remark {
        Remark::Contradicted { steps, time, told: [metres, turn], elapsed } => words::Contradicted {
            steps,
            time: &milliseconds(*time),
            metres: &decimal::fixed(*metres, 2),
            degrees: &decimal::fixed(turn.to_degrees(), 0),
            seconds: &tenths(*elapsed),
        }
        .say(),
        Remark::OtherScale { times, std } => {
            let [times, std] = [*times, *std].map(|x| decimal::fixed(x, 3));
            words::OtherScale { times: &times, std: &std }.say()
        }
        Remark::NeverMoved(scans) => words::NeverMoved { scans }.say(),
        Remark::OpenLoops { loops, time } => words::OpenLoops { loops, time: &milliseconds(*time) }.say(),
        Remark::NothingMet => words::nothing_met().into(),
        _ => words::other().into(),
    }
}

/// The log with all that was noted of it in words, for a program that knows neither its format nor the language.
pub fn in_words(mut log: LaserLog) -> LaserLog {
    let notes = &mut log.notes;
    notes.remarks = notes.remarks.iter().map(|noted| Remark::Told(remark(noted))).collect();
    if let Some(first) = &mut notes.first_malformed {
        first.problem = LogProblem::Told(problem(&first.problem));
    }
    log
}

fn field(field: Field) -> String {
    match field {
        Field::Named(name) => name.into(),
        Field::Time => words::time().into(),
        Field::Metres => words::metres().into(),
        Field::Name => words::a_name().into(),
        Field::RangeCount => words::range_count().into(),
        Field::RemissionCount => words::remission_count().into(),
        Field::Remission => words::remissions().into(),
        Field::Range { number, of } => words::RangeNumber { number: &number, of: &of }.say(),
        _ => words::other().into(),
    }
}

fn of_message(problem: &MessageProblem) -> String {
    match problem {
        MessageProblem::Short => words::short().into(),
        MessageProblem::Pose => words::message_pose().into(),
        MessageProblem::Transform => words::message_transform().into(),
        MessageProblem::NoRanges => words::message_no_ranges().into(),
        MessageProblem::Angles { first, step } => {
            words::MessageAngles { first: &number(*first), step: &number(*step) }.say()
        }
        MessageProblem::Encoding(name) => words::Encoding { name }.say(),
        MessageProblem::Encapsulation([first, second]) => {
            words::Encapsulation { bytes: &format_args!("{first:02x}{second:02x}") }.say()
        }
        _ => words::other().into(),
    }
}

fn topics(Topics { listed, more }: &Topics) -> String {
    match (listed.join(", "), more) {
        (none, _) if none.is_empty() => words::no_topic().into(),
        (all, 0) => all,
        (some, more) => words::MoreTopics { topics: &some, more }.say(),
    }
}

fn but(kind: Option<&String>) -> String {
    kind.map(|kind| words::But { kind }.say()).unwrap_or_default()
}

/// Whatever a file says, on one short line.
fn number(x: f64) -> String {
    if x.abs() < 1e15 || !x.is_finite() {
        return decimal::write(x);
    }
    let (digits, exponent) = decimal::significant(x, DIGITS);
    format!("{digits}e{exponent}")
}

/// Digits of numbers that are too large for anything: more would not be told apart from what is lost on the way to their power of ten.
const DIGITS: i32 = 12;

fn tenths(x: f64) -> String {
    decimal::fixed(x, 1)
}

fn milliseconds(seconds: f64) -> String {
    decimal::fixed(seconds, 3)
}
