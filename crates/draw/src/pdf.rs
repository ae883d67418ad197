//! Scenes as PDF: vectors, with the fonts; without a date, so that the bytes are the same always.

use std::collections::{BTreeMap, BTreeSet};

use pdf_writer::types::{
    CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use crate::font::{self, ASCENT, DESCENT, Face};
use crate::palette::{Paint, Paper};
use crate::raster::offset;
use crate::scene::{Anchor, Outline, Scene, SceneItem};
use crate::text::{DROP, INDEX, Text};

/// Points to the millimetre.
const POINTS_PER_MM: f64 = 72.0 / 25.4;
/// Control points of a quarter of a circle of radius 1.
const QUARTER: f64 = 0.552_284_749_8;
const ROMAN: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// Draws a scene on one page of its size.
pub fn pdf(scene: &Scene, paper: Paper) -> Vec<u8> {
    let mut writer = PdfWriter {
        content: Content::new(),
        paper,
        opacities: BTreeSet::new(),
        letters: [BTreeMap::new(), BTreeMap::new()],
        images: Vec::new(),
    };
    writer.page(scene);
    writer.finish(scene)
}

struct PdfWriter<'s> {
    content: Content,
    paper: Paper,
    /// Opacities in use, in thousandths.
    opacities: BTreeSet<u16>,
    /// Glyphs in use with their letters: upright, slanted.
    letters: [BTreeMap<u16, char>; 2],
    images: Vec<(usize, &'s [Option<Paint>])>,
}

fn shrunk(bytes: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, 9)
}

fn opacity_name(thousandths: u16) -> String {
    format!("O{thousandths}")
}

impl<'s> PdfWriter<'s> {
    fn page(&mut self, scene: &'s Scene) {
        let (scale, height) = (POINTS_PER_MM as f32, (scene.height * POINTS_PER_MM) as f32);
        self.content.save_state();
        self.content.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
        self.content.set_line_join(LineJoinStyle::RoundJoin);
        if self.paper == Paper::Dark {
            self.fill(Paint::Paper);
            self.content.rect(0.0, 0.0, scene.width as f32, scene.height as f32).fill_nonzero();
        }
        scene.items.iter().for_each(|item| self.item(item));
        self.content.restore_state();
    }

    fn fill(&mut self, paint: Paint) {
        let [r, g, b] = paint.on(self.paper).map(|part| f32::from(part) / 255.0);
        self.content.set_fill_rgb(r, g, b);
    }

    fn stroke(&mut self, paint: Paint, width: f64) {
        let [r, g, b] = paint.on(self.paper).map(|part| f32::from(part) / 255.0);
        self.content.set_stroke_rgb(r, g, b);
        self.content.set_line_width(width as f32);
    }

    /// Draws with an opacity.
    fn faint(&mut self, opacity: f64, draw: impl FnOnce(&mut Self)) {
        if opacity >= 1.0 {
            return draw(self);
        }
        let thousandths = (opacity.max(0.0) * 1000.0).round() as u16;
        self.opacities.insert(thousandths);
        self.content.save_state();
        self.content.set_parameters(Name(opacity_name(thousandths).as_bytes()));
        draw(self);
        self.content.restore_state();
    }

    fn item(&mut self, item: &'s SceneItem) {
        match item {
            SceneItem::Dots { at, diameter, paint, opacity } => self.faint(*opacity, |own| {
                own.stroke(*paint, *diameter);
                own.content.set_line_cap(LineCapStyle::RoundCap);
                for [x, y] in at {
                    let (x, y) = (hundredth(*x), hundredth(*y));
                    own.content.move_to(x, y).line_to(x, y);
                    if *opacity < 1.0 {
                        own.content.stroke();
                    }
                }
                if *opacity >= 1.0 && !at.is_empty() {
                    own.content.stroke();
                }
                own.content.set_line_cap(LineCapStyle::ButtCap);
            }),
            SceneItem::Lines { lines, width, paint, opacity } => self.faint(*opacity, |own| {
                own.stroke(*paint, *width);
                for line in lines.iter().filter(|line| line.len() > 1) {
                    own.follow(line);
                    own.content.stroke();
                }
            }),
            SceneItem::Boxes { boxes, paint } => {
                self.fill(*paint);
                for place in boxes {
                    let [x, y, width, height] = place.map(|v| v as f32);
                    self.content.rect(x, y, width, height);
                }
                if !boxes.is_empty() {
                    self.content.fill_nonzero();
                }
            }
            SceneItem::Shape { outline, fill, stroke, opacity } => {
                if let Some(paint) = fill {
                    self.faint(*opacity, |own| {
                        own.fill(*paint);
                        own.outline(outline);
                        own.content.fill_nonzero();
                    });
                }
                if let Some((paint, width)) = stroke {
                    self.stroke(*paint, *width);
                    self.outline(outline);
                    self.content.stroke();
                }
            }
            SceneItem::Words { at, text, size, anchor, turned, paint } => {
                self.fill(*paint);
                self.words(*at, text, *size, *anchor, *turned);
            }
            SceneItem::Image { place, columns, pixels } => {
                let [x, y, width, height] = place.map(|v| v as f32);
                self.content.save_state();
                // An image stands on its lower edge, and the page is upside down here.
                self.content.transform([width, 0.0, 0.0, -height, x, y + height]);
                self.content.x_object(Name(format!("I{}", self.images.len()).as_bytes()));
                self.content.restore_state();
                self.images.push((*columns, pixels));
            }
        }
    }

    fn follow(&mut self, line: &[[f64; 2]]) {
        for (place, [x, y]) in line.iter().enumerate() {
            match place {
                0 => self.content.move_to(hundredth(*x), hundredth(*y)),
                _ => self.content.line_to(hundredth(*x), hundredth(*y)),
            };
        }
    }

    fn outline(&mut self, outline: &Outline) {
        match outline {
            Outline::Polygon(corners) => {
                self.follow(corners);
            }
            Outline::Circle([x, y], radius) => {
                let at = |dx: f64, dy: f64| ((x + radius * dx) as f32, (y + radius * dy) as f32);
                let start = at(1.0, 0.0);
                self.content.move_to(start.0, start.1);
                for (cos, sin) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                    let (a, b) = at(cos - QUARTER * sin, sin + QUARTER * cos);
                    let (c, d) = at(-sin + QUARTER * cos, cos + QUARTER * sin);
                    let (e, f) = at(-sin, cos);
                    self.content.cubic_to(a, b, c, d, e, f);
                }
            }
        }
        self.content.close_path();
    }

    fn words(&mut self, at: [f64; 2], text: &Text, size: f64, anchor: Anchor, turned: bool) {
        let mut along = offset(text, size, anchor);
        self.content.begin_text();
        for piece in &text.pieces {
            let face = font::face(piece.slanted);
            let size = if piece.lowered { INDEX * size } else { size };
            let drop = if piece.lowered { DROP * size / INDEX } else { 0.0 };
            let (x, y) = match turned {
                false => (at[0] + along, at[1] + drop),
                true => (at[0] + drop, at[1] - along),
            };
            let matrix = match turned {
                false => [1.0, 0.0, 0.0, -1.0, x as f32, y as f32],
                true => [0.0, -1.0, -1.0, 0.0, x as f32, y as f32],
            };
            let mut codes = Vec::new();
            for letter in piece.letters.chars() {
                let glyph = face.glyph(letter);
                self.letters[usize::from(piece.slanted)].insert(glyph, letter);
                codes.extend(glyph.to_be_bytes());
            }
            self.content.set_font(Name(font_name(piece.slanted)), size as f32);
            self.content.set_text_matrix(matrix);
            self.content.show(Str(&codes));
            along += face.width(&piece.letters) * size;
        }
        self.content.end_text();
    }

    fn finish(self, scene: &Scene) -> Vec<u8> {
        let mut pdf = Pdf::new();
        let mut last = 0;
        let mut next = || {
            last += 1;
            Ref::new(last)
        };
        let (catalog, tree, page, content, info) = (next(), next(), next(), next(), next());
        pdf.document_info(info).title(TextStr(&scene.title)).producer(TextStr("liouville"));
        pdf.catalog(catalog).pages(tree);
        pdf.pages(tree).kids([page]).count(1);
        let fonts: Vec<(bool, Ref)> = [false, true]
            .into_iter()
            .filter(|slanted| !self.letters[usize::from(*slanted)].is_empty())
            .map(|slanted| {
                let parts = [next(), next(), next(), next(), next()];
                embed(&mut pdf, slanted, &self.letters[usize::from(slanted)], parts);
                (slanted, parts[0])
            })
            .collect();
        let images: Vec<Ref> = self
            .images
            .iter()
            .map(|(columns, pixels)| {
                let colour = |pixel: &Option<Paint>| pixel.unwrap_or(Paint::Paper).on(self.paper);
                let (id, bytes) =
                    (next(), shrunk(&pixels.iter().flat_map(colour).collect::<Vec<u8>>()));
                let mut image = pdf.image_xobject(id, &bytes);
                image.filter(Filter::FlateDecode);
                image.width(*columns as i32).height((pixels.len() / (*columns).max(1)) as i32);
                image.color_space().device_rgb();
                image.bits_per_component(8);
                image.finish();
                id
            })
            .collect();
        let size = [scene.width, scene.height].map(|side| (side * POINTS_PER_MM) as f32);
        let mut drawn = pdf.page(page);
        drawn.parent(tree).media_box(Rect::new(0.0, 0.0, size[0], size[1])).contents(content);
        let mut resources = drawn.resources();
        let mut named = resources.fonts();
        for (slanted, id) in &fonts {
            named.pair(Name(font_name(*slanted)), *id);
        }
        named.finish();
        let mut states = resources.ext_g_states();
        for thousandths in &self.opacities {
            let alpha = f32::from(*thousandths) / 1000.0;
            let name = opacity_name(*thousandths);
            let mut state = states
                .insert(Name(name.as_bytes()))
                .start::<pdf_writer::writers::ExtGraphicsState<'_>>();
            state.stroking_alpha(alpha).non_stroking_alpha(alpha);
        }
        states.finish();
        let mut objects = resources.x_objects();
        for (place, id) in images.iter().enumerate() {
            objects.pair(Name(format!("I{place}").as_bytes()), *id);
        }
        objects.finish();
        resources.finish();
        drawn.finish();
        pdf.stream(content, &shrunk(&self.content.finish())).filter(Filter::FlateDecode);
        pdf.finish()
    }
}

fn font_name(slanted: bool) -> &'static [u8] {
    if slanted { b"F1" } else { b"F0" }
}

/// Rounds to hundredths of a millimetre, which are short to write.
fn hundredth(value: f64) -> f32 {
    ((value * 100.0).round() / 100.0) as f32
}

/// Embeds a font, with the widths and the letters of the glyphs in use.
fn embed(
    pdf: &mut Pdf,
    slanted: bool,
    used: &BTreeMap<u16, char>,
    [font, cid, descriptor, file, unicode]: [Ref; 5],
) {
    let face: &Face = font::face(slanted);
    let name: &[u8] =
        if slanted { b"LIOUVI+DejaVuSansCondensed-Oblique" } else { b"LIOUVI+DejaVuSansCondensed" };
    pdf.type0_font(font)
        .base_font(Name(name))
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(cid)
        .to_unicode(unicode);
    let mut described = pdf.cid_font(cid);
    described.subtype(CidFontType::Type2).base_font(Name(name)).system_info(ROMAN);
    described.font_descriptor(descriptor).default_width(0.0);
    described.cid_to_gid_map_predefined(Name(b"Identity"));
    let mut widths = described.widths();
    for glyph in used.keys() {
        widths.consecutive(*glyph, [(face.advance(*glyph) * 1000.0) as f32]);
    }
    widths.finish();
    described.finish();
    let (ascent, descent) = ((ASCENT * 1000.0) as f32, (-DESCENT * 1000.0) as f32);
    let flags = if slanted { FontFlags::SYMBOLIC | FontFlags::ITALIC } else { FontFlags::SYMBOLIC };
    pdf.font_descriptor(descriptor)
        .name(Name(name))
        .flags(flags)
        .bbox(Rect::new(-500.0, descent, 1500.0, ascent))
        .italic_angle(if slanted { -11.0 } else { 0.0 })
        .ascent(ascent)
        .descent(descent)
        .cap_height(729.0)
        .stem_v(80.0)
        .font_file2(file);
    let bytes = shrunk(face.bytes);
    let mut stream = pdf.stream(file, &bytes);
    stream.filter(Filter::FlateDecode);
    stream.pair(Name(b"Length1"), face.bytes.len() as i32);
    stream.finish();
    let mut map = UnicodeCmap::new(Name(b"Letters"), ROMAN);
    used.iter().for_each(|(glyph, letter)| map.pair(*glyph, *letter));
    pdf.cmap(unicode, &map.finish());
}
