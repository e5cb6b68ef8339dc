use super::*;

#[test]
fn parts_are_in_the_order_of_their_numbers() {
    let mut names = ["r_10.mcap", "r_9.mcap", "q_11.mcap", "r.mcap", "r_2a.mcap"];
    names.sort_by_cached_key(|name| by_number(name));
    assert_eq!(names, ["q_11.mcap", "r.mcap", "r_2a.mcap", "r_9.mcap", "r_10.mcap"]);
}

#[test]
fn metadata_names_files_with_and_without_quotation_marks_and_nothing_else() {
    let text = "rosbag2_bagfile_information:\n  version: 9\n  relative_file_paths:\n    - a_0.mcap\n    - \"b/a_1.mcap\"\n  duration:\n    - c\n";
    assert_eq!(listed(text), ["a_0.mcap", "b/a_1.mcap"]);
    assert!(listed("version: 9\n").is_empty());
}

#[test]
fn every_kind_of_file_that_cannot_be_read_is_told_by_its_first_bytes() {
    let utf16: Vec<u8> = "FLASER 2 1.0 2.0".encode_utf16().flat_map(u16::to_be_bytes).collect();
    let tar = [&[b'a'; 257][..], b"ustar\0", &[0; 100]].concat();
    for (start, said) in [
        (&b"\x37\x7a\xbc\xaf\x27\x1c"[..], "7z x"),
        (b"\xff\xfeF\0L\0", "iconv"),
        (&utf16, "iconv"),
        (&tar, "tar -xf"),
        (b" [{\"time\": 1}]", "jq -c '.[]'"),
        (b"{\n  \"time\": 1", "jq -c ."),
        (b"VERTEX_SE2 0 0 0 0\n", "landmarks --g2o"),
    ] {
        assert!(cure(start).is_some_and(|cure| cure.contains(said)), "{said}");
    }
    for start in
        [&b"FLASER 180 "[..], b"# a log\n", b"{\"time\": 1}\n", b"#ROSBAG V2.0\n", b"\x89MCAP0\r\n", b"", b"1.5 0 0"]
    {
        assert_eq!(cure(start), None, "{start:?}");
    }
}

#[test]
fn frames_of_zstd_are_read_one_after_the_other() {
    let frame =
        |text: &str| ruzstd::encoding::compress_to_vec(text.as_bytes(), ruzstd::encoding::CompressionLevel::Fastest);
    let both = [frame("one "), frame("two")].concat();
    let mut text = String::new();
    let mut frames = Frames { rest: Some(&both[..]), frame: None };
    frames.read_to_string(&mut text).unwrap();
    assert_eq!(text, "one two");
    let mut cut = Frames { rest: Some(&both[..both.len() - 1]), frame: None };
    assert!(cut.read_to_string(&mut text).is_err());
}
