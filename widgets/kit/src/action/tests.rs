use super::*;
use crate::paint::Theme;
use serde_json::{Value, json};

#[test]
fn an_action_is_read_as_the_page_writes_it() {
    let read = |sent: Value| Action::try_from(serde_json::from_value::<Message>(sent).unwrap());
    let beginning =
        |linked| Beginning { query: Some("v=9".into()), settings: "seed=4&step".into(), linked, changed: true };
    for (name, linked) in [("begin", false), ("link", true)] {
        let begin = json!({ "do": name, "value": "v=9", "name": "seed=4&step", "on": true });
        assert_eq!(read(begin), Ok(Action::Begin(beginning(linked))));
    }
    let set = |value: Option<&str>, hand| Action::Set { name: "seed".into(), value: value.map(Into::into), hand };
    assert_eq!(read(json!({ "do": "set", "name": "seed", "value": "4", "on": true })), Ok(set(Some("4"), true)));
    assert_eq!(read(json!({ "do": "set", "name": "seed", "value": null })), Ok(set(None, false)));
    let size =
        Size { room: 800.0, height: 600.0, font_scale: 1.5, css: 700.0, px: [1400, 900], theme: Theme::ContrastDark };
    let sent = json!({ "do": "size", "name": "contrast-dark", "at": [800, 600, 1.5, 700, 1400, 900] });
    assert_eq!(read(sent), Ok(Action::Size(size)));
    let drag = Action::Touch(Touch::Drag("r2".into(), [1.5, 2.0]));
    assert_eq!(read(json!({ "do": "drag", "name": "r2", "at": [1.5, 2] })), Ok(drag));
    let own = Own { name: "press".into(), with: "move".into(), at: vec![0.0, 1.0] };
    let sent = json!({ "do": "own", "name": "press", "value": "move", "at": [0, 1] });
    assert_eq!(read(sent), Ok(Action::Touch(Touch::Own(own))));
    assert_eq!(read(json!({ "do": "sett" })), Err("no such action"));
}
