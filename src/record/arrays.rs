//! Archives of arrays that `numpy.load` opens: `.npy` files in a zip. They hold no dates: the same arrays are the same bytes.

use std::fs::File;
use std::io::{BufReader, BufWriter, Error, Result, Write};
use std::path::Path;

use npyz::{AutoSerialize, Deserialize, NpyFile, WriterBuilder};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// Larger members need the wider headers of zip.
const WIDE: u64 = u32::MAX as u64;

/// How a member of an archive of about `bytes` bytes is kept.
pub(super) fn options(method: CompressionMethod, bytes: u64) -> SimpleFileOptions {
    let plain = SimpleFileOptions::default().last_modified_time(DateTime::default());
    plain.compression_method(method).large_file(bytes >= WIDE)
}

/// Writes an array as a `.npy` file: real numbers as `<f8`, counts as `<u8`.
pub(super) fn write<T: AutoSerialize>(
    into: impl Write,
    shape: &[u64],
    values: impl IntoIterator<Item = T>,
) -> Result<()> {
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(shape).writer(into).begin_nd()?;
    writer.extend(values)?;
    writer.finish()
}

/// A new archive.
pub struct Writer(ZipWriter<BufWriter<File>>);

impl Writer {
    /// Creates the file.
    ///
    /// # Errors
    /// It cannot be created.
    pub fn create(path: &Path) -> Result<Self> {
        Ok(Self(ZipWriter::new(BufWriter::new(File::create(path)?))))
    }

    /// Adds an array in the order of C.
    ///
    /// # Errors
    /// The file cannot be written, or the number of values is not that of the shape.
    pub fn add<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[u64],
        values: impl IntoIterator<Item = T>,
    ) -> Result<()> {
        let bytes = shape.iter().product::<u64>().saturating_mul(8);
        self.0.start_file(format!("{name}.npy"), options(CompressionMethod::Deflated, bytes))?;
        write(&mut self.0, shape, values)
    }

    /// Writes the list of arrays: without it the file is no archive.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(self) -> Result<()> {
        self.0.finish()?.flush()
    }
}

/// An archive that is there.
pub struct Reader(ZipArchive<BufReader<File>>);

impl Reader {
    /// Opens the file.
    ///
    /// # Errors
    /// It cannot be opened or is no archive.
    pub fn open(path: &Path) -> Result<Self> {
        Ok(Self(ZipArchive::new(BufReader::new(File::open(path)?))?))
    }

    /// All values of an array, in its order.
    ///
    /// # Errors
    /// There is no such array, it is of another type, or it is damaged.
    pub fn read<T: Deserialize>(&mut self, name: &str) -> Result<Vec<T>> {
        let member =
            self.0.by_name(&format!("{name}.npy")).map_err(|error| Error::other(format!("{name}: {error}")))?;
        NpyFile::new(member)?.into_vec()
    }
}
