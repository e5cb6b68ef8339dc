"""Makes the two font files of this folder from Debian's package fonts-inter (Inter, SIL Open Font License).

    apt-get download fonts-inter && dpkg -x fonts-inter*.deb inter
    pip install fonttools && python subset.py inter/usr/share/fonts/opentype/inter .

Keeps the letters of the languages that figures may speak, and the signs of formulas, without hinting or layout tables. `build.rs` takes
those that are written from here: a new language needs no new font, unless its script is another one. The digits are replaced by
Inter's tabular ones (feature tnum), because numbers that change in place must not make their neighbours jump.
"""
import sys

from fontTools import subset
from fontTools.ttLib import TTFont

# Latin with its accents, Greek, Cyrillic.
LETTERS = "".join(map(chr, [*range(0x20, 0x7F), *range(0xA1, 0x180), *range(0x386, 0x3CF), *range(0x400, 0x460), 0x490, 0x491]))
SIGNS = "–—‘’‚“”„†…‹›€←→−·≤≥≈√∂∑∏∫∞≠"
# Of formulas. Inter has no ∈ ᵀ ⟨ ⟩ ∝ ⊕.
INDICES = "⁻⁺⁰₀₁₂₃ₜₓᵢⱼΔΩ"


def tabular_digits(font):
    features = [f.Feature for f in font["GSUB"].table.FeatureList.FeatureRecord if f.FeatureTag == "tnum"]
    lookups = font["GSUB"].table.LookupList.Lookup
    swaps = {}
    for index in features[0].LookupListIndex:
        for table in lookups[index].SubTable:
            table = getattr(table, "ExtSubTable", table)
            swaps.update(getattr(table, "mapping", {}))
    for cmap in font["cmap"].tables:
        for digit in "0123456789":
            if ord(digit) in cmap.cmap:
                cmap.cmap[ord(digit)] = swaps.get(cmap.cmap[ord(digit)], cmap.cmap[ord(digit)])


def make(source, target):
    font = TTFont(source)
    tabular_digits(font)
    options = subset.Options(hinting=False, layout_features=[], name_IDs=[0, 1, 2, 13, 14], glyph_names=False, desubroutinize=True)
    options.drop_tables += ["GSUB", "GPOS", "GDEF"]
    subsetter = subset.Subsetter(options)
    subsetter.populate(text=LETTERS + SIGNS + INDICES)
    subsetter.subset(font)
    missing = [c for c in SIGNS + INDICES if ord(c) not in font.getBestCmap()]
    assert not missing, missing
    font.save(target)


if __name__ == "__main__":
    folder, out = sys.argv[1:]
    for weight in ("Regular", "SemiBold"):
        make(f"{folder}/Inter-{weight}.otf", f"{out}/Inter-{weight}-subset.otf")
