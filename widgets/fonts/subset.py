"""Makes the two font files of this folder from Debian's package fonts-inter (Inter, SIL Open Font License).

    apt-get download fonts-inter && dpkg -x fonts-inter*.deb inter
    pip install fonttools && python subset.py inter/usr/share/fonts/opentype/inter .

Keeps the characters our figures write, without hinting or layout tables. The digits are replaced by Inter's tabular ones
(feature tnum), because numbers that change in place must not make their neighbours jump.
"""
import sys

from fontTools import subset
from fontTools.ttLib import TTFont

TEXT = "".join(map(chr, range(0x20, 0x7F))) + "←→×±σαη√²³°–—−·…≤≥≈’†"
# Of formulas. Inter has no ∈ ᵀ ⟨ ⟩ ∝ ⊕.
FORMULAS = "μνφθδκχπρτωΔΛΣΩ∂∑∏∫∞≠½¼⁻¹⁺⁰₀₁₂₃ₜₓᵢⱼ"
CHARACTERS = TEXT + FORMULAS


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
    subsetter.populate(text=CHARACTERS)
    subsetter.subset(font)
    missing = [c for c in CHARACTERS if ord(c) not in font.getBestCmap()]
    assert not missing, missing
    font.save(target)


if __name__ == "__main__":
    folder, out = sys.argv[1:]
    for weight in ("Regular", "SemiBold"):
        make(f"{folder}/Inter-{weight}.otf", f"{out}/Inter-{weight}-subset.otf")
