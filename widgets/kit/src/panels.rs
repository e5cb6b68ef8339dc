//! Parts of a picture that can be shown by themselves: one small chart beside a sentence, rather than the whole figure.

use crate::{
    model::FigureError,
    param::quoted,
    words::kit::{self, SomePanels},
};

/// Which panels of a view are shown: all of them, unless an author asks for some.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Panels(Option<Vec<&'static str>>);

impl Panels {
    /// The panels that `names` names, apart by spaces, of those that there are; `all` or nothing is all of them.
    ///
    /// # Errors
    /// For a name that is not among them; the error has those that are.
    pub fn named(names: &str, all: &[&'static str]) -> Result<Self, FigureError> {
        if names.trim().is_empty() || names.trim() == "all" {
            return Ok(Self(None));
        }
        let find = |name: &str| all.iter().copied().find(|panel| *panel == name);
        let found: Option<Vec<&'static str>> = names.split_whitespace().map(find).collect();
        let allowed = || match all {
            [] => kit::one_piece().into(),
            _ => SomePanels { panels: &all.join(", ") }.say(),
        };
        let shown = found.ok_or_else(|| FigureError::new("show", quoted(names), allowed()))?;
        Ok(Self(Some(shown)))
    }

    /// These, and no others.
    pub fn of(names: &[&'static str]) -> Self {
        Self(Some(names.into()))
    }

    /// Whether a panel is shown.
    pub fn has(&self, name: &str) -> bool {
        self.0.as_ref().is_none_or(|shown| shown.contains(&name))
    }

    /// Whether nothing is left out.
    pub fn are_all(&self) -> bool {
        self.0.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_apart_by_spaces_are_shown_and_without_any_all_are() {
        let of = |names| Panels::named(names, &["map", "mosaic", "n-eff"]).unwrap();
        for names in ["", "  ", "all"] {
            assert!(of(names).are_all() && of(names).has("map"), "{names:?}");
        }
        let some = of(" n-eff  map ");
        assert_eq!(["map", "mosaic", "n-eff"].map(|name| some.has(name)), [true, false, true]);
        assert!(!some.are_all());
    }

    #[test]
    fn an_unknown_name_is_refused_with_those_that_there_are() {
        let error = Panels::named("map tree", &["map", "n-eff"]).unwrap_err();
        assert_eq!(error.parameter, "show");
        assert_eq!(error.message, "show = \"map tree\": must be all, or some of map, n-eff");
        assert!(Panels::named("map", &[]).unwrap_err().message.contains("one piece"));
    }
}
